// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"

#include <algorithm>

#include <fmt/format.h>
#include <utf8.h>

namespace scoria::core {
namespace {

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

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

}  // namespace scoria::core
