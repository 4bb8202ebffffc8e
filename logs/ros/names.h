// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string_view>

/// Small pieces that the parsers of this folder share.
namespace scoria::logs {

[[nodiscard]] inline std::string_view WithoutOuterSpace(std::string_view text) noexcept {
  constexpr std::string_view kSpace = " \t\r\f\v\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) + 1 - first);
}

[[nodiscard]] constexpr bool IsDigit(char c) noexcept { return c >= '0' && c <= '9'; }
[[nodiscard]] constexpr bool IsLetter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A letter or underscore, then letters, digits, underscores.
[[nodiscard]] inline bool IsName(std::string_view text) noexcept {
  return !text.empty() && IsLetter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return IsLetter(c) || IsDigit(c); });
}

}  // namespace scoria::logs
