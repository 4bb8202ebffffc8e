// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/field_type.h"

namespace scoria::logs {

/// The value of a field, or the values of an array or sequence, where they lie in the bytes of a
/// message. As long as these bytes live. Values are read from the bytes when they are asked for.
class FieldView {
 public:
  /// Absent: an element beyond the end of a sequence.
  FieldView() = default;

  /// @param data  the first value; text begins with its length.
  FieldView(FieldType type, const std::byte* data, std::size_t size, bool is_big_endian,
            int wide_char_bytes) noexcept
      : data_(data),
        size_(size),
        type_(type),
        is_big_endian_(is_big_endian),
        wide_char_bytes_(static_cast<std::uint8_t>(wide_char_bytes)) {}

  [[nodiscard]] bool IsAbsent() const noexcept { return data_ == nullptr; }
  [[nodiscard]] FieldType type() const noexcept { return type_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }  // 1 for a single value

  /// A number, bool (0, 1) or time (s) as a double.
  /// @pre here and below: not absent, i < size(), a type as said.
  [[nodiscard]] double Double(std::size_t i = 0) const;

  /// An integer, bool or time (ns) exactly; of a uint64 the same bits.
  [[nodiscard]] std::int64_t Int(std::size_t i = 0) const;

  /// A string, without its terminator. Elements before the i-th are stepped over.
  [[nodiscard]] std::string_view Text(std::size_t i = 0) const;

  /// The text of strings and wstrings (as UTF-8; U+FFFD for what is no character).
  [[nodiscard]] std::vector<std::string> Texts() const;

  /// A value as text that reads back to the same value: shortest digits of floats, true and false,
  /// seconds with nine decimals of times.
  [[nodiscard]] std::string Format(std::size_t i = 0) const;

  /// The i-th element alone; absent if there is none.
  [[nodiscard]] FieldView Element(std::size_t i) const noexcept;

 private:
  [[nodiscard]] const std::byte* TextAt(std::size_t i) const noexcept;
  [[nodiscard]] const std::byte* AfterText(const std::byte* text) const noexcept;
  [[nodiscard]] std::string_view StringAt(const std::byte* text) const noexcept;
  [[nodiscard]] std::uint32_t LengthAt(const std::byte* text) const noexcept;
  [[nodiscard]] std::string Utf8At(const std::byte* text) const;

  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  FieldType type_ = FieldType::kBool;
  bool is_big_endian_ = false;
  std::uint8_t wide_char_bytes_ = 4;
};

}  // namespace scoria::logs
