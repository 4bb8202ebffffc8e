// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace scoria::logs {

/// What one value of a ROS message is. `byte`, `octet` and `char` are uint8.
enum class FieldType : std::uint8_t {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,
  kWstring,
  kTime,    // a struct of int32 sec and uint32 nanosec, read as one value
  kStruct,  // any other
};

enum class Multiplicity : std::uint8_t { kOne, kArray, kSequence };

/// Encoded bytes of a number, bool or time; 0 for text and structs.
[[nodiscard]] constexpr std::size_t SizeOf(FieldType type) noexcept {
  constexpr std::array<std::uint8_t, 15> kSizes = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 0, 0, 8, 0};
  return kSizes[static_cast<std::size_t>(type)];
}

/// As .msg texts write it; "time", "struct".
[[nodiscard]] std::string_view NameOf(FieldType type) noexcept;

/// The type that a .msg text calls so, if it is none of the composed ones.
[[nodiscard]] std::optional<FieldType> PrimitiveNamed(std::string_view name) noexcept;

[[nodiscard]] constexpr bool IsText(FieldType type) noexcept {
  return type == FieldType::kString || type == FieldType::kWstring;
}

/// Neither text nor struct: bool and time are numbers here.
[[nodiscard]] constexpr bool IsNumber(FieldType type) noexcept {
  return !IsText(type) && type != FieldType::kStruct;
}

}  // namespace scoria::logs
