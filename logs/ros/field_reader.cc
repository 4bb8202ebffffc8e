// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/field_reader.h"

#include <algorithm>

#include "logs/ros/message_walker.h"

namespace scoria::logs {

/// Puts the views of wanted leaves into their slots.
class SelectionHandler {
 public:
  SelectionHandler(FieldReader& reader, const FieldReader::Selection* selection)
      : reader_(reader), selection_(selection) {}

  [[nodiscard]] SelectionHandler Child(const StructLayout&, std::size_t i) const {
    if (selection_ == nullptr || selection_->children.empty()) return {reader_, nullptr};
    return At(selection_->children[i]);
  }

  [[nodiscard]] SelectionHandler Element(std::size_t i) const {
    if (selection_ == nullptr) return *this;
    const auto& elements = selection_->elements;
    const auto found =
        std::lower_bound(elements.begin(), elements.end(), std::pair{i, std::size_t{0}});
    return At(found == elements.end() || found->first != i ? 0 : found->second);
  }

  [[nodiscard]] bool MaySkip(const StructLayout&) const { return selection_ == nullptr; }

  void Leaf(const FieldView& view) const {
    if (selection_ == nullptr) return;
    for (const FieldReader::Wanted& wanted : selection_->wanted) {
      reader_.values_[wanted.slot] = wanted.element ? view.Element(*wanted.element) : view;
    }
  }

  void Time(const FieldView& view) const { Leaf(view); }

 private:
  [[nodiscard]] SelectionHandler At(std::size_t index) const {
    return {reader_, index == 0 ? nullptr : &reader_.selections_[index]};
  }

  FieldReader& reader_;
  const FieldReader::Selection* selection_;
};

FieldReader::FieldReader(const MessageType& type, const std::vector<std::string>& paths)
    : type_(type), selections_(1), values_(paths.size()) {
  for (const std::string& path : paths) fields_.push_back(ResolveField(type, path));
  for (std::size_t slot = 0; slot < fields_.size(); ++slot) Select(slot);
}

void FieldReader::Select(std::size_t slot) {
  const ResolvedField& field = fields_[slot];
  const StructLayout* layout = &type_.root();
  std::size_t at = 0;
  for (const FieldStep& step : field.steps) {
    const Member& member = layout->members[step.member];
    at = ChildOf(at, *layout, step.member);
    const bool is_struct = member.type == FieldType::kStruct;
    if (is_struct && step.element) at = ElementOf(at, *step.element);
    if (is_struct) layout = &type_.StructOf(member);
    if (&step != &field.steps.back()) continue;
    selections_[at].wanted.push_back({slot, is_struct ? std::nullopt : step.element});
  }
}

std::size_t FieldReader::ChildOf(std::size_t selection, const StructLayout& layout,
                                 std::size_t member) {
  selections_[selection].children.resize(layout.members.size(), 0);
  const std::size_t known = selections_[selection].children[member];
  if (known != 0) return known;
  selections_[selection].children[member] = selections_.size();
  selections_.emplace_back();
  return selections_.size() - 1;
}

std::size_t FieldReader::ElementOf(std::size_t selection, std::uint64_t element) {
  auto& elements = selections_[selection].elements;
  const auto place =
      std::lower_bound(elements.begin(), elements.end(), std::pair{element, std::size_t{0}});
  if (place != elements.end() && place->first == element) return place->second;
  const std::size_t index = selections_.size();
  elements.insert(place, {element, index});
  selections_.emplace_back();
  return index;
}

std::span<const FieldView> FieldReader::Read(std::span<const std::byte> message) {
  std::fill(values_.begin(), values_.end(), FieldView());
  MessageWalker<SelectionHandler>(type_, message).Walk(SelectionHandler(*this, &selections_[0]));
  return values_;
}

}  // namespace scoria::logs
