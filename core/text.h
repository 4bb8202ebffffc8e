// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scoria::core {

/// Offset of the first byte that is not UTF-8; nothing if all are.
[[nodiscard]] std::optional<std::size_t> FindInvalidUtf8(std::string_view text);

/// Line and column of a byte, counted from 1.
struct TextPlace {
  int line = 1, column = 1;
};
[[nodiscard]] TextPlace PlaceOf(std::string_view text, std::size_t offset);

/// `text` as a message may show it: on one line, control characters as spaces, bytes that are not
/// UTF-8 as \xHH, and cut after `longest` bytes with its whole length.
[[nodiscard]] std::string Shown(std::string_view text, std::size_t longest = 60);

/// `text` with every byte that is not UTF-8 replaced by U+FFFD and control characters by spaces.
[[nodiscard]] std::string PrintableText(std::string_view text);

/// XML with its comments as spaces; every other byte stays where it was.
[[nodiscard]] std::string BlankXmlComments(std::string_view xml);

/// ` (did you mean "x"?)` for the nearest of `choices`, or nothing when none is near.
[[nodiscard]] std::string DidYouMean(std::string_view word,
                                     const std::vector<std::string>& choices);

}  // namespace scoria::core
