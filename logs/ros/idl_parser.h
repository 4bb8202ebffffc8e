// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "logs/ros/definition.h"

namespace scoria::logs {

/// Reads the structs of IDL, as rosidl writes it or as DDS projects write it by hand: one file, or
/// a `ros2idl` schema in which every file follows a line of "=" and a line "IDL: pkg/msg/Name".
/// Modules, structs, typedefs, enums (uint32), constants, sequences and arrays; of annotations only
/// those count that change the encoding.
///   struct pkg::msg::Name is "pkg/msg/Name"; pkg::Name is that as well.
///   double m[3][3] is an array of 9.
/// @param source  what messages call the text, such as its path.
/// Errors: DefinitionError, "SOURCE:LINE: \"TEXT\": rule", also for what ROS messages cannot hold
/// (unions, maps, optional members, arrays within sequences). Structs of other files need not be
/// known here.
/// Source: [IDL] 7.4.1, 7.4.13; [XTypes] 7.3.1.
[[nodiscard]] std::vector<MessageDefinition> ParseIdl(std::string_view text,
                                                      const std::string& source);

}  // namespace scoria::logs
