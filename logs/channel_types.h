// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/ros/message_type.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// What a channel's container says of its messages.
[[nodiscard]] ChannelSchema SchemaOf(const LogChannel& channel);

/// What each channel of a log may be, in their order. No message has been shown.
[[nodiscard]] std::vector<TypeChoice> ResolveTypes(const LogContents& contents,
                                                   const TypeResolver& resolver);

/// Where messages of a type carry the time that they tell of: "header.stamp", or "stamp"; none if
/// they do not.
[[nodiscard]] std::optional<std::string> StampPathOf(const MessageType& type);

}  // namespace scoria::logs
