// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/source.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "core/file_kind.h"
#include "core/text.h"

namespace scoria::core {
namespace {

/// The key whose value stands at the end of a line's beginning, empty if none.
std::string KeyBefore(const std::string& line_start) {
  const std::regex pattern(R"(^[^#]*?([A-Za-z_][A-Za-z0-9_.]*)\s*[:=][^:=#]*$)");
  std::smatch match;
  return std::regex_match(line_start, match, pattern) ? match[1].str() : "";
}

}  // namespace

std::string ReadYamlText(const std::filesystem::path& file, const Origin& asked_by) {
  constexpr std::size_t kHead = 4096;
  constexpr std::uintmax_t kLargest = 16 << 20;  // no scenario is; its parsing would take minutes
  const std::string name = file.string(), key = asked_by.line > 0 ? "base" : "";
  if (std::filesystem::is_directory(file))
    throw ConfigError(asked_by, key, fmt::format("{} is a folder, not a YAML file", name));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ConfigError(asked_by, key, fmt::format("cannot read the file {}", name));
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  const FileKind kind = KindOfContent(head);
  if (!kind.name.empty()) throw ConfigError({name, 0, 0}, "", NotOfKind(kind, "a YAML file"));
  std::error_code no_size;  // of a pipe
  const std::uintmax_t size = std::filesystem::file_size(file, no_size);
  if (!no_size && size > kLargest) {
    throw ConfigError({name, 0, 0}, "",
                      fmt::format("has {} MiB; a YAML file of scoria has at most {}", size >> 20,
                                  kLargest >> 20));
  }
  std::ostringstream rest;
  rest << in.rdbuf();
  return head + rest.str();
}

void CheckUtf8(const std::string& text, const Origin& origin) {
  const std::optional<std::size_t> at = FindInvalidUtf8(text);
  if (!at) return;
  const TextPlace place = PlaceOf(text, *at);
  constexpr std::size_t kFarthest = 200;  // std::regex recurses per character
  const std::size_t before = std::min(kFarthest, static_cast<std::size_t>(place.column - 1));
  const Origin exact =
      origin.from_command_line ? origin : Origin{origin.file, place.line, place.column, false};
  throw ConfigError(exact, KeyBefore(text.substr(*at - before, before)),
                    fmt::format("byte 0x{:02X} is not UTF-8; save the file as UTF-8",
                                static_cast<unsigned char>(text[*at])));
}

}  // namespace scoria::core
