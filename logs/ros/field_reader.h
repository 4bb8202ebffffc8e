// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "logs/ros/field_path.h"
#include "logs/ros/field_view.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// Reads chosen fields of messages of one type, all in one walk over the bytes, without allocation.
///
///     FieldReader reader(type, {"header.stamp", "motor_state[3].q", "position"});
///     const auto values = reader.Read(message);
///     const double q_rad = values[1].Double();
class FieldReader {
 public:
  /// @param type   must outlive the reader.
  /// @param paths  as ResolveField takes them; one may be there twice.
  /// Errors: FieldPathError.
  FieldReader(const MessageType& type, const std::vector<std::string>& paths);
  FieldReader(const MessageType&&, const std::vector<std::string>&) = delete;

  [[nodiscard]] const std::vector<ResolvedField>& fields() const noexcept { return fields_; }

  /// The fields of a message in the order of the paths, valid until the next call and as long as
  /// the bytes of the message. Absent are elements beyond the end of a sequence.
  /// Errors: MessageError.
  std::span<const FieldView> Read(std::span<const std::byte> message);

 private:
  friend class SelectionHandler;
  struct Wanted {
    std::size_t slot = 0;
    std::optional<std::uint64_t> element;
  };
  /// What is wanted of a struct, member or element.
  struct Selection {
    std::vector<std::size_t> children;  // by member; 0 where nothing of it is wanted
    std::vector<std::pair<std::uint64_t, std::size_t>> elements;  // sorted
    std::vector<Wanted> wanted;
  };

  void Select(std::size_t slot);
  std::size_t ChildOf(std::size_t selection, const StructLayout& layout, std::size_t member);
  std::size_t ElementOf(std::size_t selection, std::uint64_t element);

  const MessageType& type_;
  std::vector<ResolvedField> fields_;
  std::vector<Selection> selections_;  // the root first
  std::vector<FieldView> values_;
};

}  // namespace scoria::logs
