// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/idl_parser.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "logs/ros/idl_declarations.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {
namespace {

constexpr int kDeepestAlias = 32;

std::string WithSlashes(std::string name) {
  for (std::size_t at = 0; (at = name.find("::", at)) != std::string::npos;)
    name.replace(at, 2, "/");
  return name;
}

/// Names looked up, the innermost scope first.
class IdlResolver {
 public:
  IdlResolver(const IdlDeclarations& declared, const std::string& source)
      : declared_(declared), source_(source) {
    for (const IdlStruct& s : declared.structs) structs_.insert(s.name);
  }

  [[nodiscard]] MessageDefinition MessageOf(const IdlStruct& idl) const {
    MessageDefinition message;
    message.name = FullTypeName(WithSlashes(idl.name));
    message.extensibility = idl.extensibility;
    std::set<std::string> names;
    for (const IdlMember& member : idl.members) {
      FieldDefinition field = FieldOf(member.type, 0);
      field.name = member.name;
      if (!names.insert(field.name).second) {
        FailIdl(source_, member.type.line, field.name, "there are two fields of that name");
      }
      message.fields.push_back(std::move(field));
    }
    const std::string constants = idl.name + "_Constants::";  // the module that rosidl writes
    for (auto c = declared_.constants.lower_bound(constants);
         c != declared_.constants.end() && c->first.starts_with(constants); ++c) {
      message.constants.push_back(
          {c->second.type, c->first.substr(constants.size()), c->second.value});
    }
    return message;
  }

 private:
  /// The scoped name that `name` means within `scope` among those of `names`; empty if none.
  template <class Names>
  static std::string Find(const Names& names, const std::string& name, std::string scope) {
    if (name.starts_with("::")) return names.contains(name.substr(2)) ? name.substr(2) : "";
    for (;;) {
      std::string candidate = scope.empty() ? name : scope + "::" + name;
      if (names.contains(candidate)) return candidate;
      if (scope.empty()) return "";
      const std::size_t cut = scope.rfind("::");
      scope.resize(cut == std::string::npos ? 0 : cut);
    }
  }

  FieldDefinition FieldOf(const IdlType& type, int depth) const {
    if (depth > kDeepestAlias)
      FailIdl(source_, type.line, type.name, "typedefs go round in circles");
    FieldDefinition field = BaseOf(type, depth);
    if (!type.string_bound.empty()) field.string_bound = LengthOf(type.string_bound, type);
    if (type.is_sequence) {
      if (field.multiplicity != Multiplicity::kOne) {
        FailIdl(source_, type.line, type.name, "a sequence of arrays or sequences is not read");
      }
      field.multiplicity = Multiplicity::kSequence;
      if (!type.bound.empty()) field.count = LengthOf(type.bound, type);
    }
    for (const std::string& dimension : type.dimensions) {
      if (field.multiplicity == Multiplicity::kSequence) {
        FailIdl(source_, type.line, type.name, "an array of sequences is not read");
      }
      const std::uint64_t length = LengthOf(dimension, type);
      field.count = field.multiplicity == Multiplicity::kOne ? length : field.count * length;
      field.multiplicity = Multiplicity::kArray;
      if (field.count > kLongestArray)
        FailIdl(source_, type.line, type.name, "the array is too long");
    }
    return field;
  }

  FieldDefinition BaseOf(const IdlType& type, int depth) const {
    FieldDefinition field;
    field.type = type.name;
    if (type.is_primitive) return field;
    if (const std::string alias = Find(declared_.aliases, type.name, type.scope); !alias.empty()) {
      return FieldOf(declared_.aliases.at(alias), depth + 1);
    }
    if (!Find(declared_.enums, type.name, type.scope).empty()) {
      field.type = "uint32";
      return field;
    }
    std::string name = Find(structs_, type.name, type.scope);
    if (name.empty()) {  // of another file
      name = type.name.starts_with("::") ? type.name.substr(2) : type.name;
      if (name.find("::") == std::string::npos && !type.scope.empty())
        name = type.scope + "::" + name;
    }
    field.type = FullTypeName(WithSlashes(name));
    return field;
  }

  std::uint64_t LengthOf(const std::string& text, const IdlType& type) const {
    const std::string name = Find(declared_.constants, text, type.scope);
    std::string_view digits = name.empty() ? text : declared_.constants.at(name).value;
    const int base = digits.starts_with("0x") || digits.starts_with("0X") ? 16 : 10;
    if (base == 16) digits.remove_prefix(2);
    std::uint64_t value = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (error != std::errc() || end != digits.data() + digits.size() || value == 0 ||
        value > kLongestArray) {
      FailIdl(source_, type.line, text, fmt::format("is not a length (1 to {})", kLongestArray));
    }
    return value;
  }

  const IdlDeclarations& declared_;
  const std::string& source_;
  std::set<std::string> structs_;
};

}  // namespace

std::vector<MessageDefinition> ParseIdl(std::string_view text, const std::string& source) {
  IdlDeclarations declared;
  for (const DefinitionSection& section : SplitSchema(text, source)) {
    declared = WithIdlText(std::move(declared), section, source);
  }
  const IdlResolver resolver(declared, source);
  std::vector<MessageDefinition> messages;
  for (const IdlStruct& idl : declared.structs) messages.push_back(resolver.MessageOf(idl));
  return messages;
}

}  // namespace scoria::logs
