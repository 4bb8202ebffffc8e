// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/visit_leaves.h"

#include <fmt/format.h>

#include "logs/ros/message_walker.h"

namespace scoria::logs {

class VisitHandler {
 public:
  VisitHandler(LeafPath& path, const OnLeaf& on_leaf, std::size_t depth)
      : path_(path), on_leaf_(on_leaf), depth_(depth) {}

  [[nodiscard]] VisitHandler Child(const StructLayout& layout, std::size_t i) const {
    path_.parts_[depth_] = {&layout.members[i], 0, false};
    return {path_, on_leaf_, depth_ + 1};
  }

  [[nodiscard]] VisitHandler Element(std::size_t i) const {
    path_.parts_[depth_ - 1].element = i;
    path_.parts_[depth_ - 1].has_element = true;
    return *this;
  }

  [[nodiscard]] bool MaySkip(const StructLayout&) const { return false; }

  void Leaf(const FieldView& view) const {
    path_.size_ = depth_;
    if (!path_.parts_[depth_ - 1].member->is_filler) on_leaf_(path_, view);
  }

  void Time(const FieldView&) const {}

 private:
  LeafPath& path_;
  const OnLeaf& on_leaf_;
  std::size_t depth_;
};

std::string LeafPath::Text() const {
  std::string text;
  for (std::size_t i = 0; i < size_; ++i) {
    if (i > 0) text += '.';
    text += parts_[i].member->name;
    if (parts_[i].has_element) text += fmt::format("[{}]", parts_[i].element);
  }
  return text;
}

void VisitLeaves(const MessageType& type, std::span<const std::byte> message,
                 const OnLeaf& on_leaf) {
  LeafPath path;
  MessageWalker<VisitHandler>(type, message).Walk(VisitHandler(path, on_leaf, 0));
}

}  // namespace scoria::logs
