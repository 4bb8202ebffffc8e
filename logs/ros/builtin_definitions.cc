// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>

#include "logs/ros/definition_source.h"
#include "logs/ros/embedded_definitions.h"
#include "logs/ros/msg_parser.h"
#include "logs/ros/names.h"

namespace scoria::logs {
namespace {

constexpr std::string_view kVariant = "VARIANT:";
constexpr std::string_view kTitle = "MSG:";

/// Reads a file of logs/ros/definitions: a line "VARIANT: WORDS" where there are other layouts
/// under the same names, then types, each a line "MSG: pkg/Name" and its fields.
ListedDefinitions ParseEmbedded(const EmbeddedText& file) {
  std::string name = "built in";
  std::string_view text = file.text;
  if (text.starts_with(kVariant)) {
    const std::string_view line = text.substr(0, text.find('\n'));
    name += fmt::format(", {}", WithoutOuterSpace(line.substr(kVariant.size())));
  }
  std::vector<MessageDefinition> messages;
  for (std::size_t at = text.find(kTitle); at < text.size();) {
    const std::size_t next = std::min(text.find(kTitle, at + 1), text.size());
    const std::string_view section = text.substr(at, next - at);
    const std::string_view title = section.substr(0, section.find('\n'));
    const std::string type = FullTypeName(WithoutOuterSpace(title.substr(kTitle.size())));
    messages.push_back(ParseMsg(section.substr(title.size()), type, std::string(file.name)));
    at = next;
  }
  return {std::move(name), std::move(messages)};
}

}  // namespace

std::vector<ListedDefinitions> BuiltInDefinitions() {
  std::vector<ListedDefinitions> sources;
  for (const EmbeddedText& file : EmbeddedDefinitions()) sources.push_back(ParseEmbedded(file));
  return sources;
}

}  // namespace scoria::logs
