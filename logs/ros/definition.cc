// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/definition.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/names.h"

namespace scoria::logs {
namespace {

/// Of 80 characters by its source; shorter ones are met.
bool IsSeparator(std::string_view line) {
  return line.size() >= 20 && line.find_first_not_of('=') == std::string_view::npos;
}

/// Takes lines off the front of a text.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  [[nodiscard]] bool IsAtEnd() const { return rest_.empty(); }
  [[nodiscard]] int number() const { return number_; }  // of the line taken last
  [[nodiscard]] const char* position() const { return rest_.data(); }
  std::string_view Next() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return WithoutOuterSpace(line);
  }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// The name in "MSG: pkg/Name"; empty if the line is none.
std::string_view NameOnTitleLine(std::string_view line) {
  if (!line.starts_with("MSG:") && !line.starts_with("IDL:")) return {};
  return WithoutOuterSpace(line.substr(4));
}

std::string_view Between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string FullTypeName(std::string_view name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos || name.find('/', slash + 1) != std::string_view::npos) {
    return std::string(name);
  }
  return fmt::format("{}/msg/{}", name.substr(0, slash), name.substr(slash + 1));
}

std::string_view ShortTypeName(std::string_view name) {
  return name.substr(name.rfind('/') + 1);  // npos + 1 is 0
}

std::vector<DefinitionSection> SplitSchema(std::string_view text, const std::string& source) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<DefinitionSection> sections;
  Lines lines(text);
  DefinitionSection section;
  const char* begin = text.data();
  const auto end_section = [&](const char* end) {
    section.text = Between(begin, end);
    if (!section.type_name.empty() || !WithoutOuterSpace(section.text).empty())
      sections.push_back(section);
  };
  while (!lines.IsAtEnd()) {
    const char* const line_begin = lines.position();
    std::string_view line = lines.Next();
    if (!IsSeparator(line)) continue;
    end_section(line_begin);
    line = {};
    while (line.empty() && !lines.IsAtEnd()) line = lines.Next();
    if (NameOnTitleLine(line).empty()) {
      throw DefinitionError(
          fmt::format("{}:{}: \"{}\": a line of = is followed by \"MSG: pkg/Name\" or "
                      "\"IDL: pkg/msg/Name\"",
                      source, lines.number(), core::Shown(line)));
    }
    section = {std::string(NameOnTitleLine(line)), lines.number() + 1, {}};
    begin = lines.position();
  }
  end_section(text.data() + text.size());
  if (sections.empty()) sections.push_back({"", 1, text});
  return sections;
}

}  // namespace scoria::logs
