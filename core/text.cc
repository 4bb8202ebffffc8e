// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <utf8.h>

namespace scoria::core {
namespace {

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Edits (insert, delete, replace) between two words.
int EditDistance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({replace, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::size_t> FindInvalidUtf8(std::string_view text) {
  const auto at = utf8::find_invalid(text.begin(), text.end());
  if (at == text.end()) return std::nullopt;
  return static_cast<std::size_t>(at - text.begin());
}

TextPlace PlaceOf(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(offset - line_start)};
}

std::string Shown(std::string_view text, std::size_t longest) {
  std::string out;
  auto at = text.begin();
  while (at != text.end() && out.size() < longest) {
    const auto valid_end = utf8::find_invalid(at, std::min(at + 4, text.end()));
    if (valid_end == at) {
      out += fmt::format("\\x{:02X}", static_cast<unsigned char>(*at++));
      continue;
    }
    const auto start = at;
    utf8::unchecked::next(at);
    out += IsControl(*start) ? " " : std::string(start, at);
  }
  return at == text.end() ? out : fmt::format("{}... ({} bytes)", out, text.size());
}

std::string PrintableText(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto valid_end = utf8::find_invalid(text.begin(), text.end());
    const auto valid = static_cast<std::size_t>(valid_end - text.begin());
    out += text.substr(0, valid);
    text.remove_prefix(valid);
    if (text.empty()) break;
    out += "\ufffd";
    text.remove_prefix(1);
  }
  std::replace_if(out.begin(), out.end(), IsControl, ' ');
  return out;
}

std::string BlankXmlComments(std::string_view xml) {
  constexpr std::string_view kOpen = "<!--", kClose = "-->";
  std::string out(xml);
  for (std::size_t at = out.find(kOpen); at != std::string::npos; at = out.find(kOpen, at)) {
    const std::size_t close = out.find(kClose, at + kOpen.size());
    const std::size_t end = close == std::string::npos ? out.size() : close + kClose.size();
    for (; at < end; ++at) {
      if (out[at] != '\n') out[at] = ' ';
    }
  }
  return out;
}

std::string DidYouMean(std::string_view word, const std::vector<std::string>& choices) {
  constexpr std::size_t kLongestWord = 100;
  if (word.size() > kLongestWord) return "";
  const std::string* best = nullptr;
  int best_distance = 1 + static_cast<int>(std::max<std::size_t>(2, word.size() / 3));
  for (const std::string& choice : choices) {
    const int distance = EditDistance(word, choice);
    if (distance < best_distance) {
      best_distance = distance;
      best = &choice;
    }
  }
  return best == nullptr ? "" : fmt::format(" (did you mean \"{}\"?)", *best);
}

}  // namespace scoria::core
