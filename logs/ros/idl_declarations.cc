// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/idl_declarations.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/idl_lexer.h"

namespace scoria::logs {
namespace {

constexpr int kDeepestModule = 32;

/// IDL's names of one or more words, and those of .msg texts.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kPrimitives = {
    {{"boolean", "bool"},
     {"octet", "uint8"},
     {"char", "uint8"},
     {"short", "int16"},
     {"long", "int32"},
     {"long long", "int64"},
     {"unsigned short", "uint16"},
     {"unsigned long", "uint32"},
     {"unsigned long long", "uint64"},
     {"int8", "int8"},
     {"uint8", "uint8"},
     {"int16", "int16"},
     {"uint16", "uint16"},
     {"int32", "int32"},
     {"uint32", "uint32"},
     {"int64", "int64"},
     {"uint64", "uint64"},
     {"float", "float32"},
     {"double", "float64"},
     {"string", "string"},
     {"wstring", "wstring"},
     {"long double", ""},
     {"wchar", ""},
     {"fixed", ""}}};

class DeclarationParser {
 public:
  DeclarationParser(const DefinitionSection& section, const std::string& source,
                    IdlDeclarations declared)
      : lexer_(section.text, section.first_line), source_(source), declared_(std::move(declared)) {
    Take();
  }

  IdlDeclarations Parse() {
    while (token_.kind != IdlToken::Kind::kEnd) ParseDeclaration();
    return std::move(declared_);
  }

 private:
  [[noreturn]] void Fail(std::string_view rule) const {
    FailIdl(source_, token_.line, token_.kind == IdlToken::Kind::kEnd ? "end" : token_.text, rule);
  }

  /// Returns the token at hand and goes on to the next.
  IdlToken Take() { return std::exchange(token_, lexer_.Next()); }
  [[nodiscard]] bool Is(std::string_view text) const {
    return token_.kind != IdlToken::Kind::kText && token_.text == text;
  }
  bool TakeIf(std::string_view text) {
    if (!Is(text)) return false;
    Take();
    return true;
  }
  void Expect(std::string_view text) {
    if (!TakeIf(text)) Fail(fmt::format("\"{}\" is expected", text));
  }
  std::string TakeName() {
    if (token_.kind != IdlToken::Kind::kName) Fail("a name is expected");
    return std::string(Take().text);
  }
  [[nodiscard]] std::string Scoped(const std::string& name) const {
    return scope_.empty() ? name : scope_ + "::" + name;
  }

  void ParseDeclaration() {
    const Extensibility extensibility = ParseAnnotations();
    if (TakeIf("module")) return ParseModule();
    if (TakeIf("struct")) return ParseStruct(extensibility);
    if (TakeIf("typedef")) return ParseTypedef();
    if (TakeIf("enum")) return ParseEnum();
    if (TakeIf("const")) return ParseConstant();
    if (TakeIf(";")) return;
    Fail("a module, struct, typedef, enum or const is expected");
  }

  void ParseModule() {
    if (++depth_ > kDeepestModule) Fail("modules are nested too deep");
    const std::string outer = scope_;
    scope_ = Scoped(TakeName());
    Expect("{");
    while (!TakeIf("}")) ParseDeclaration();
    TakeIf(";");
    scope_ = outer;
    --depth_;
  }

  void ParseStruct(Extensibility extensibility) {
    IdlStruct result;
    result.name = Scoped(TakeName());
    result.extensibility = extensibility;
    if (TakeIf(";")) return;  // announced only
    if (Is(":")) Fail("a struct that inherits is not read");
    Expect("{");
    while (!TakeIf("}")) {
      ParseAnnotations();
      const IdlType type = ParseType();
      do {
        result.members.push_back(ParseDeclarator(type));
      } while (TakeIf(","));
      Expect(";");
    }
    Expect(";");
    declared_.structs.push_back(std::move(result));
  }

  void ParseTypedef() {
    const IdlType type = ParseType();
    do {
      IdlMember alias = ParseDeclarator(type);
      declared_.aliases.insert_or_assign(Scoped(alias.name), std::move(alias.type));
    } while (TakeIf(","));
    Expect(";");
  }

  void ParseEnum() {
    declared_.enums.insert(Scoped(TakeName()));
    Expect("{");
    do {
      if (Is("}")) break;
      ParseAnnotations();
      TakeName();
      if (TakeIf("=")) Take();
    } while (TakeIf(","));
    Expect("}");
    Expect(";");
  }

  void ParseConstant() {
    const IdlType type = ParseType();
    const std::string name = Scoped(TakeName());
    Expect("=");
    std::string value;
    while (!Is(";")) {
      if (token_.kind == IdlToken::Kind::kEnd) Fail("\";\" is expected");
      const IdlToken part = Take();
      const bool is_text = part.kind == IdlToken::Kind::kText && part.text.size() >= 2;
      value += is_text ? part.text.substr(1, part.text.size() - 2) : part.text;
    }
    Expect(";");
    declared_.constants.insert_or_assign(name, IdlConstant{type.name, value});
  }

  /// "NAME" or "NAME[N][M]".
  IdlMember ParseDeclarator(IdlType type) {
    IdlMember member;
    type.line = token_.line;
    member.name = TakeName();
    while (TakeIf("[")) {
      type.dimensions.push_back(ParseLength());
      Expect("]");
    }
    member.type = std::move(type);
    return member;
  }

  std::string ParseLength() {
    if (token_.kind == IdlToken::Kind::kNumber) return std::string(Take().text);
    return ParseScopedName();
  }

  std::string ParseScopedName() {
    std::string name = TakeIf("::") ? "::" : "";
    name += TakeName();
    while (TakeIf("::")) name += "::" + TakeName();
    return name;
  }

  IdlType ParseType() {
    IdlType type;
    type.line = token_.line;
    type.scope = scope_;
    if (TakeIf("sequence")) {
      Expect("<");
      ParseAnnotations();
      if (Is("sequence")) Fail("a sequence of sequences is not read");
      type = ParseType();
      type.is_sequence = true;
      if (TakeIf(",")) type.bound = ParseLength();
      Expect(">");
      return type;
    }
    const std::string_view primitive = TakePrimitive();
    type.is_primitive = !primitive.empty();
    type.name = type.is_primitive ? std::string(primitive) : ParseScopedName();
    if (type.is_primitive && IsText(*PrimitiveNamed(type.name)) && TakeIf("<")) {
      type.string_bound = ParseLength();
      Expect(">");
    }
    return type;
  }

  /// Takes the words of a primitive. @returns what .msg texts call it; nothing, and takes nothing,
  /// if the token at hand begins none.
  std::string_view TakePrimitive() {
    constexpr std::array<std::string_view, 5> kRefused = {"union", "struct", "map", "any", "enum"};
    for (const std::string_view word : kRefused) {
      if (Is(word)) Fail("is not read here");
    }
    if (token_.kind != IdlToken::Kind::kName) return {};
    std::string words(token_.text);
    const bool has_more_words = words == "unsigned" || words == "long";
    if (has_more_words) {
      Take();
      while (Is("short") || Is("long") || (Is("double") && words == "long")) {
        words += fmt::format(" {}", Take().text);
      }
    }
    for (const auto& [idl, msg] : kPrimitives) {
      if (idl != words) continue;
      if (msg.empty()) Fail(fmt::format("{} is not a type of ROS messages", words));
      if (!has_more_words) Take();
      return msg;
    }
    if (has_more_words) Fail(fmt::format("\"{}\" is not a type", words));
    return {};
  }

  /// Takes annotations; of those that make no difference to the encoding nothing is kept.
  Extensibility ParseAnnotations() {
    Extensibility found = Extensibility::kAsMessage;
    while (TakeIf("@")) {
      const std::string name = ParseScopedName();
      std::string argument;
      if (TakeIf("(")) argument = ParseArgument();
      if (name == "optional" || name == "bit_bound") {
        Fail(fmt::format("@{} is not read", name));
      }
      if (name == "final" || argument == "FINAL") found = Extensibility::kFinal;
      if (name == "appendable" || argument == "APPENDABLE") {
        found = Extensibility::kAppendable;
      }
      if (name == "mutable" || argument == "MUTABLE") Fail("a mutable struct is not read");
    }
    return found;
  }

  /// What stands in the parentheses of an annotation, without spaces.
  std::string ParseArgument() {
    std::string argument;
    for (int open = 1;;) {
      if (token_.kind == IdlToken::Kind::kEnd) Fail("\")\" is expected");
      if (Is("(")) ++open;
      if (Is(")") && --open == 0) break;
      argument += Take().text;
    }
    Expect(")");
    return argument;
  }

  IdlLexer lexer_;
  std::string source_, scope_;
  IdlToken token_;
  IdlDeclarations declared_;
  int depth_ = 0;
};

}  // namespace

void FailIdl(const std::string& source, int line, std::string_view text, std::string_view rule) {
  throw DefinitionError(fmt::format("{}:{}: \"{}\": {}", source, line, core::Shown(text), rule));
}

IdlDeclarations WithIdlText(IdlDeclarations declared, const DefinitionSection& section,
                            const std::string& source) {
  return DeclarationParser(section, source, std::move(declared)).Parse();
}

}  // namespace scoria::logs
