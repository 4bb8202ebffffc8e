// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/format/log_source.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// Drafts the text of a mapping file for a log, by names and types of its fields, by the ranges of
/// their first values, and by what kinematics and gravity demand of them. What the log does not
/// tell, and what was guessed, is said by comments.
[[nodiscard]] std::string DraftMapping(LogSource& log, const TypeResolver& resolver);

}  // namespace scoria::logs
