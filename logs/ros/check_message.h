// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "logs/ros/message_type.h"

namespace scoria::logs {

/// Holds a message against a definition that may be another one's: every field must be there and
/// in its bounds, every bool 0 or 1, every string readable (UTF-8 without control characters but
/// tab and line ends), and at most 3 bytes of padding may be left behind the last field.
/// Errors: MessageError.
void CheckMessage(const MessageType& type, std::span<const std::byte> message);

}  // namespace scoria::logs
