// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/definition.h"

namespace scoria::logs {

/// A type as an IDL text writes it. Names and lengths are not looked up yet.
struct IdlType {
  std::string name;  // a primitive as .msg texts write it, or a name "a::b::C"
  bool is_primitive = false;
  std::string scope;  // where the name stands, "a::b"
  bool is_sequence = false;
  std::string bound, string_bound;      // numbers or names of constants; empty if there is none
  std::vector<std::string> dimensions;  // of an array, likewise
  int line = 1;
};

struct IdlMember {
  std::string name;
  IdlType type;
};

struct IdlStruct {
  std::string name;  // "a::b::C"
  std::vector<IdlMember> members;
  Extensibility extensibility = Extensibility::kAsMessage;
};

struct IdlConstant {
  std::string type, value;
};

/// What an IDL text declares, by names "a::b::C".
struct IdlDeclarations {
  std::vector<IdlStruct> structs;
  std::map<std::string, IdlType> aliases;
  std::set<std::string> enums;
  std::map<std::string, IdlConstant> constants;
};

/// Adds the declarations of one text to `declared`.
/// Errors: DefinitionError, "SOURCE:LINE: \"TEXT\": rule".
[[nodiscard]] IdlDeclarations WithIdlText(IdlDeclarations declared,
                                          const DefinitionSection& section,
                                          const std::string& source);

/// Errors: this one, always.
[[noreturn]] void FailIdl(const std::string& source, int line, std::string_view text,
                          std::string_view rule);

}  // namespace scoria::logs
