// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "logs/ros/field_view.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// The path of a leaf of a message, with the elements at hand: "motor_state[3].q".
class LeafPath {
 public:
  [[nodiscard]] std::string Text() const;

 private:
  friend class VisitHandler;
  struct Part {
    const Member* member = nullptr;
    std::size_t element = 0;
    bool has_element = false;
  };
  std::array<Part, MessageType::kDeepest> parts_;
  std::size_t size_ = 0;
};

/// Called for every leaf in the order of the message: numbers or texts; one, or all of an array or
/// sequence at once.
using OnLeaf = std::function<void(const LeafPath&, const FieldView&)>;

/// Walks over all of a message.
/// Errors: MessageError, when the leaves before the place have been shown.
void VisitLeaves(const MessageType& type, std::span<const std::byte> message,
                 const OnLeaf& on_leaf);

}  // namespace scoria::logs
