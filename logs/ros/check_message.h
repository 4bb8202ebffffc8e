// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "logs/ros/message_type.h"

namespace scoria::logs {

/// More bytes behind the last field are no padding.
inline constexpr std::size_t kMostPadding = 3;

/// Reads all of a message: every field must be there and in its bounds, every bool 0 or 1.
/// @returns the number of bytes behind the last field.
/// Errors, here and below: MessageError.
std::size_t MeasureRest(const MessageType& type, std::span<const std::byte> message);

/// Holds a message against a definition that may be another one's: as MeasureRest, and besides
/// every string must be readable (UTF-8 without control characters but tab and line ends) and at
/// most kMostPadding bytes may be left.
void CheckMessage(const MessageType& type, std::span<const std::byte> message);

}  // namespace scoria::logs
