// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/field_type.h"

namespace scoria::logs {

/// A text that defines messages and cannot be used: "SOURCE:LINE: \"TEXT\": rule".
struct DefinitionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct FieldDefinition {
  std::string name;
  std::string type;  // a primitive as .msg texts write it, or the full name of a message
  Multiplicity multiplicity = Multiplicity::kOne;
  std::uint64_t count = 0;         // length of an array; bound of a sequence, 0 if it has none
  std::uint64_t string_bound = 0;  // characters of a bounded string; 0 if it has none
  std::string default_text;        // as written
  bool operator==(const FieldDefinition&) const = default;
};

struct ConstantDefinition {
  std::string type, name, value;  // the value of a string without its quotes
  bool operator==(const ConstantDefinition&) const = default;
};

/// Whether XCDR2 writes the size of a struct before it. Source: [XTypes] 7.4.3.
enum class Extensibility : std::uint8_t {
  kAsMessage,   // as the message's encapsulation says
  kFinal,       // never
  kAppendable,  // always
};

/// A message type as its .msg or .idl text gives it.
struct MessageDefinition {
  std::string name;  // "pkg/msg/Name"
  std::vector<FieldDefinition> fields;
  std::vector<ConstantDefinition> constants;
  Extensibility extensibility = Extensibility::kAsMessage;
  bool operator==(const MessageDefinition&) const = default;
};

/// "pkg/Name" as "pkg/msg/Name"; other names as they are.
[[nodiscard]] std::string FullTypeName(std::string_view name);

/// "Name" of "pkg/msg/Name".
[[nodiscard]] std::string_view ShortTypeName(std::string_view name);

/// One of the texts that a schema of several types is put together from.
struct DefinitionSection {
  std::string type_name;  // after "MSG:" or "IDL:", as written; empty before the first separator
  int first_line = 1;     // of the text, in the schema
  std::string_view text;
};

/// Splits a schema at its lines of "=" that a line "MSG: pkg/Name" or "IDL: pkg/msg/Name" follows.
/// A first section without a name is there if it holds more than white space, or is the only one.
/// Source: [MCAP] registry of well-known schema encodings, ros2msg and ros2idl.
/// Errors: DefinitionError, by `source` and line.
[[nodiscard]] std::vector<DefinitionSection> SplitSchema(std::string_view text,
                                                         const std::string& source);

}  // namespace scoria::logs
