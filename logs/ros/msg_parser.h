// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/definition.h"

namespace scoria::logs {

/// Reads the text of one .msg file.
/// @param type_name  "pkg/msg/Name": names without a package in the text are of that package.
/// @param source     what messages call the text, such as its path.
/// Errors: DefinitionError, "SOURCE:LINE: \"TEXT\": rule". Types that the text names need not be
/// known here.
/// Source: [ROS2Interfaces] grammar of .msg files; ROS 1's bare `Header` is left to who looks the
/// type up.
[[nodiscard]] MessageDefinition ParseMsg(std::string_view text, const std::string& type_name,
                                         const std::string& source, int first_line = 1);

/// Reads a `ros2msg` schema: the text of `type_name`, then those of the types that it uses, each
/// after a line of "=" and a line "MSG: pkg/Name". The first of the result is `type_name`. A name
/// without a package that is none of its own package is the one of another package in the schema,
/// if there is one.
/// Errors: as ParseMsg.
[[nodiscard]] std::vector<MessageDefinition> ParseRos2Msg(std::string_view schema,
                                                          const std::string& type_name,
                                                          const std::string& source);

}  // namespace scoria::logs
