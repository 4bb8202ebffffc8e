// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/ros/message_type.h"

namespace scoria::logs {

/// A type as a `ros2msg` schema that ParseRos2Msg reads back: the fields of the type, then those of
/// every type that it uses, once. Constants and defaults, which no message needs, are left out.
[[nodiscard]] std::string WriteRos2Msg(const MessageType& type);

}  // namespace scoria::logs
