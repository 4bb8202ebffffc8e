// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "logs/ros/message_type.h"
#include "logs/ros/msg_parser.h"

namespace scoria::test {

/// The type "pkg/msg/Type" of a ros2msg schema that holds all that it uses.
inline logs::MessageType TypeOf(const std::vector<logs::MessageDefinition>& messages) {
  return logs::MessageType(messages.at(0), [&](const std::string& name) {
    for (const logs::MessageDefinition& message : messages) {
      if (message.name == name) return std::optional(message);
    }
    return std::optional<logs::MessageDefinition>();
  });
}

inline logs::MessageType TypeOf(const std::string& schema) {
  return TypeOf(logs::ParseRos2Msg(schema, "pkg/msg/Type", "schema"));
}

/// What an exception of that kind says; "no error" without one.
template <class Error, class Call>
std::string ErrorOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline constexpr const char* kLine =
    "\n================================================================================\n";

}  // namespace scoria::test
