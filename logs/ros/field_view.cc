// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/field_view.h"

#include <bit>
#include <cstdlib>
#include <iterator>

#include <fmt/format.h>
#include <utf8.h>

#include "core/demand.h"
#include "logs/ros/bytes.h"

namespace scoria::logs {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

struct TimeParts {
  std::int32_t sec;
  std::uint32_t nanosec;
};

TimeParts LoadTime(const std::byte* data, bool big) {
  return {static_cast<std::int32_t>(LoadUnsigned<std::uint32_t>(data, big)),
          LoadUnsigned<std::uint32_t>(data + 4, big)};
}

/// A surrogate half that stands alone, or a number above the last character.
bool IsNoCharacter(char32_t c) { return (c >= 0xD800 && c < 0xE000) || c > 0x10FFFF; }

void AppendCharacter(char32_t c, std::string& text) {
  utf8::append(static_cast<std::uint32_t>(IsNoCharacter(c) ? U'\uFFFD' : c),
               std::back_inserter(text));
}

bool IsHighSurrogate(char32_t c) { return c >= 0xD800 && c < 0xDC00; }
bool IsLowSurrogate(char32_t c) { return c >= 0xDC00 && c < 0xE000; }

}  // namespace

double FieldView::Double(std::size_t i) const {
  SCORIA_DEMAND(i < size_ && IsNumber(type_), "{} of {}, {}", i, size_, NameOf(type_));
  const std::byte* at = data_ + i * SizeOf(type_);
  switch (type_) {
    case FieldType::kFloat64:
      return std::bit_cast<double>(LoadUnsigned<std::uint64_t>(at, is_big_endian_));
    case FieldType::kFloat32:
      return std::bit_cast<float>(LoadUnsigned<std::uint32_t>(at, is_big_endian_));
    case FieldType::kUint64:
      return static_cast<double>(LoadUnsigned<std::uint64_t>(at, is_big_endian_));
    case FieldType::kTime: {
      const TimeParts time = LoadTime(at, is_big_endian_);
      return time.sec + time.nanosec / 1e9;
    }
    default:
      return static_cast<double>(Int(i));
  }
}

std::int64_t FieldView::Int(std::size_t i) const {
  SCORIA_DEMAND(i < size_ && IsNumber(type_), "{} of {}, {}", i, size_, NameOf(type_));
  const std::byte* at = data_ + i * SizeOf(type_);
  const bool big = is_big_endian_;
  switch (type_) {
    case FieldType::kBool:
    case FieldType::kUint8:
      return std::to_integer<std::uint8_t>(*at);
    case FieldType::kInt8:
      return static_cast<std::int8_t>(std::to_integer<std::uint8_t>(*at));
    case FieldType::kInt16:
      return static_cast<std::int16_t>(LoadUnsigned<std::uint16_t>(at, big));
    case FieldType::kUint16:
      return LoadUnsigned<std::uint16_t>(at, big);
    case FieldType::kInt32:
      return static_cast<std::int32_t>(LoadUnsigned<std::uint32_t>(at, big));
    case FieldType::kUint32:
      return LoadUnsigned<std::uint32_t>(at, big);
    case FieldType::kInt64:
    case FieldType::kUint64:
      return static_cast<std::int64_t>(LoadUnsigned<std::uint64_t>(at, big));
    case FieldType::kTime: {
      const TimeParts time = LoadTime(at, big);
      return time.sec * kNsPerS + time.nanosec;
    }
    default:
      SCORIA_DEMAND(false, "{} is no integer", NameOf(type_));
      return 0;
  }
}

std::uint32_t FieldView::LengthAt(const std::byte* text) const noexcept {
  return LoadUnsigned<std::uint32_t>(text, is_big_endian_);
}

const std::byte* FieldView::AfterText(const std::byte* text) const noexcept {
  const std::size_t unit = type_ == FieldType::kWstring ? wide_char_bytes_ : 1;
  return text + 4 + (LengthAt(text) * unit + 3) / 4 * 4;  // lengths are aligned to 4
}

const std::byte* FieldView::TextAt(std::size_t i) const noexcept {
  const std::byte* at = data_;
  for (; i > 0; --i) at = AfterText(at);
  return at;
}

std::string_view FieldView::StringAt(const std::byte* text) const noexcept {
  const std::uint32_t length = LengthAt(text);  // with terminator, which an empty string may lack
  return {static_cast<const char*>(static_cast<const void*>(text + 4)),
          length == 0 ? std::size_t{0} : length - 1};
}

std::string_view FieldView::Text(std::size_t i) const {
  SCORIA_DEMAND(i < size_ && type_ == FieldType::kString, "{} of {}, {}", i, size_, NameOf(type_));
  return StringAt(TextAt(i));
}

std::string FieldView::Utf8At(const std::byte* text) const {
  const std::uint32_t length = LengthAt(text);
  const auto load = [&](std::uint32_t k) -> char32_t {
    const std::byte* at = text + 4 + std::size_t{k} * wide_char_bytes_;
    if (wide_char_bytes_ == 2) return LoadUnsigned<std::uint16_t>(at, is_big_endian_);
    return LoadUnsigned<std::uint32_t>(at, is_big_endian_);
  };
  std::string utf8;
  for (std::uint32_t k = 0; k < length; ++k) {
    char32_t c = load(k);
    if (IsHighSurrogate(c) && k + 1 < length && IsLowSurrogate(load(k + 1))) {
      c = 0x10000 + ((c - 0xD800) << 10) + (load(++k) - 0xDC00);
    }
    AppendCharacter(c, utf8);
  }
  return utf8;
}

std::vector<std::string> FieldView::Texts() const {
  SCORIA_DEMAND(IsText(type_), "{}", NameOf(type_));
  std::vector<std::string> texts;
  texts.reserve(size_);
  const std::byte* at = data_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (i > 0) at = AfterText(at);
    texts.push_back(type_ == FieldType::kString ? std::string(StringAt(at)) : Utf8At(at));
  }
  return texts;
}

std::string FieldView::Format(std::size_t i) const {
  switch (type_) {
    case FieldType::kString:
      return std::string(Text(i));
    case FieldType::kWstring:
      SCORIA_DEMAND(i < size_, "{} of {}", i, size_);
      return Utf8At(TextAt(i));
    case FieldType::kBool:
      return Int(i) != 0 ? "true" : "false";
    case FieldType::kFloat32:
      return fmt::format("{}", static_cast<float>(Double(i)));
    case FieldType::kFloat64:
      return fmt::format("{}", Double(i));
    case FieldType::kUint64:
      return fmt::format("{}", static_cast<std::uint64_t>(Int(i)));
    case FieldType::kTime: {
      const std::int64_t ns = Int(i);
      return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", std::abs(ns / kNsPerS),
                         std::abs(ns % kNsPerS));
    }
    default:
      return fmt::format("{}", Int(i));
  }
}

FieldView FieldView::Element(std::size_t i) const noexcept {
  if (i >= size_) return {};
  FieldView element = *this;
  element.size_ = 1;
  element.data_ = IsText(type_) ? TextAt(i) : data_ + i * SizeOf(type_);
  return element;
}

}  // namespace scoria::logs
