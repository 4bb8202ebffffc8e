// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/message_type.h"

namespace scoria::logs {

/// A path that names nothing in its type: "PATH: rule (did you mean ...)".
struct FieldPathError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One part of a path, looked up: a member of a struct, and which element of it.
struct FieldStep {
  std::size_t member = 0;  // in StructLayout::members
  std::optional<std::uint64_t> element;
};

/// Where a field is in a type, and what it holds.
struct ResolvedField {
  std::string path;  // as asked for
  std::vector<FieldStep> steps;
  FieldType type = FieldType::kFloat64;
  Multiplicity multiplicity = Multiplicity::kOne;  // of what the path names
  std::uint64_t count = 1;                         // as in Member
};

/// Looks up a path such as "imu_state.quaternion[2]", "motor_state[3].q", "pose.pose.position.x".
/// Elements count from 0. A path ends at a number or text, at a whole array or sequence of these
/// ("position"), or at a struct of int32 sec and uint32 nanosec, which is one time
/// ("header.stamp"). Errors: FieldPathError.
[[nodiscard]] ResolvedField ResolveField(const MessageType& type, std::string_view path);

}  // namespace scoria::logs
