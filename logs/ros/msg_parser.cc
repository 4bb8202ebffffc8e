// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/msg_parser.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/message_type.h"
#include "logs/ros/names.h"

namespace scoria::logs {
namespace {

constexpr std::string_view kBlank = " \t\r\f\v";

/// The line up to its comment; "#" within quotes is text.
std::string_view WithoutComment(std::string_view line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0') {
      if (c == '\\') ++i;
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return line.substr(0, i);
    }
  }
  return line;
}

/// "Name", "pkg/Name" or "pkg/msg/Name".
bool IsTypeName(std::string_view text) {
  int parts = 0;
  for (;;) {
    const std::size_t slash = text.find('/');
    if (!IsName(text.substr(0, slash)) || ++parts > 3) return false;
    if (slash == std::string_view::npos) return true;
    text.remove_prefix(slash + 1);
  }
}

std::string WithoutQuotes(std::string_view text) {
  const bool quoted =
      text.size() >= 2 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0];
  return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

class MsgParser {
 public:
  MsgParser(std::string_view text, const std::string& type_name, const std::string& source,
            int first_line)
      : text_(text),
        package_(type_name.substr(0, type_name.find('/'))),
        source_(source),
        line_number_(first_line) {
    message_.name = type_name;
  }

  MessageDefinition Parse() {
    for (;; ++line_number_) {
      const std::size_t end = text_.find('\n');
      line_ = WithoutOuterSpace(WithoutComment(text_.substr(0, end)));
      if (!line_.empty()) ParseLine();
      if (end == std::string_view::npos) return message_;
      text_.remove_prefix(end + 1);
    }
  }

 private:
  [[noreturn]] void Fail(const std::string& rule) const {
    throw DefinitionError(
        fmt::format("{}:{}: \"{}\": {}", source_, line_number_, core::Shown(line_), rule));
  }

  void ParseLine() {
    if (line_ == "---") Fail("a service or action is not one message");
    const std::size_t type_end = std::min(line_.find_first_of(kBlank), line_.size());
    FieldDefinition field = ParseType(line_.substr(0, type_end));
    const std::string_view rest = WithoutOuterSpace(line_.substr(type_end));
    const std::size_t name_end = std::min(rest.find_first_of(" \t=\r\f\v"), rest.size());
    field.name = rest.substr(0, name_end);
    if (field.name.empty()) Fail("a type is followed by the name of a field");
    if (!IsName(field.name)) Fail(fmt::format("\"{}\" is not a name", core::Shown(field.name)));
    const std::string_view value = WithoutOuterSpace(rest.substr(name_end));
    if (value.starts_with('=')) {
      AddConstant(field, WithoutOuterSpace(value.substr(1)));
    } else {
      field.default_text = value;
      AddField(field);
    }
  }

  void AddConstant(const FieldDefinition& field, std::string_view value) {
    const bool is_text = field.type == "string" || field.type == "wstring";
    if (field.multiplicity != Multiplicity::kOne || !PrimitiveNamed(field.type)) {
      Fail("a constant is one number, bool or string");
    }
    if (value.empty() && !is_text) Fail("a constant has a value");
    message_.constants.push_back({field.type, field.name, WithoutQuotes(value)});
  }

  void AddField(const FieldDefinition& field) {
    if (!names_.insert(field.name).second) {
      Fail(fmt::format("there are two fields \"{}\"", field.name));
    }
    message_.fields.push_back(field);
  }

  /// "TYPE", "string<=N", either with "[]", "[N]" or "[<=N]" behind.
  FieldDefinition ParseType(std::string_view text) const {
    FieldDefinition field;
    if (text.ends_with(']')) {
      const std::size_t open = text.find('[');
      if (open == std::string_view::npos) Fail("\"]\" without \"[\"");
      ParseBrackets(text.substr(open + 1, text.size() - open - 2), field);
      text = text.substr(0, open);
    }
    if (const std::size_t bound = text.find("<="); bound != std::string_view::npos) {
      field.string_bound = ParseLength(text.substr(bound + 2));
      text = text.substr(0, bound);
      if (text != "string" && text != "wstring")
        Fail("\"<=N\" bounds a string or an array \"[<=N]\"");
    }
    if (!IsTypeName(text)) Fail(fmt::format("\"{}\" is not a type", core::Shown(text)));
    if (PrimitiveNamed(text)) {
      field.type = text;
    } else if (text.find('/') == std::string_view::npos) {
      field.type = fmt::format("{}/msg/{}", package_, text);
    } else {
      field.type = FullTypeName(text);
    }
    return field;
  }

  void ParseBrackets(std::string_view inside, FieldDefinition& field) const {
    if (inside.empty()) {
      field.multiplicity = Multiplicity::kSequence;
    } else if (inside.starts_with("<=")) {
      field.multiplicity = Multiplicity::kSequence;
      field.count = ParseLength(inside.substr(2));
    } else {
      field.multiplicity = Multiplicity::kArray;
      field.count = ParseLength(inside);
    }
  }

  std::uint64_t ParseLength(std::string_view text) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0 ||
        value > kLongestArray) {
      Fail(fmt::format("\"{}\" is not a length (1 to {})", core::Shown(text), kLongestArray));
    }
    return value;
  }

  std::string_view text_;
  std::string package_, source_;
  int line_number_;
  std::string_view line_;
  std::set<std::string> names_;
  MessageDefinition message_;
};

/// Names without a package that some writers mean of another one.
void CompletePackages(std::vector<MessageDefinition>& messages) {
  std::map<std::string, std::string> known;       // by full name
  std::multimap<std::string, std::string> named;  // by short name
  for (const MessageDefinition& message : messages) {
    if (!known.emplace(message.name, "").second) continue;
    named.emplace(ShortTypeName(message.name), message.name);
  }
  for (MessageDefinition& message : messages) {
    for (FieldDefinition& field : message.fields) {
      const std::string short_name(ShortTypeName(field.type));
      if (known.contains(field.type) || named.count(short_name) != 1) continue;
      field.type = named.find(short_name)->second;
    }
  }
}

}  // namespace

MessageDefinition ParseMsg(std::string_view text, const std::string& type_name,
                           const std::string& source, int first_line) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return MsgParser(text, type_name, source, first_line).Parse();
}

std::vector<MessageDefinition> ParseRos2Msg(std::string_view schema, const std::string& type_name,
                                            const std::string& source) {
  std::vector<MessageDefinition> messages;
  for (const DefinitionSection& section : SplitSchema(schema, source)) {
    const std::string name =
        section.type_name.empty() ? type_name : FullTypeName(section.type_name);
    messages.push_back(ParseMsg(section.text, name, source, section.first_line));
  }
  const auto root = std::find_if(messages.begin(), messages.end(),
                                 [&](const auto& message) { return message.name == type_name; });
  if (root == messages.end()) {  // a message without fields, before those of others
    messages.insert(messages.begin(), {type_name, {}, {}, Extensibility::kAsMessage});
  } else {
    std::rotate(messages.begin(), root, root + 1);
  }
  CompletePackages(messages);
  return messages;
}

}  // namespace scoria::logs
