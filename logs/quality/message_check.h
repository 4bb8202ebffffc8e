// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "logs/format/log_source.h"
#include "logs/quality/finding.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// What only the messages of a log tell, and not its rows: messages lost by their own counters, and
/// which of two clocks is regular, the stamps in the messages or the times of recording. Findings
/// name the topic. Reads the log twice; memory does not grow with it.
/// Errors: core::FileError.
[[nodiscard]] std::vector<Finding> JudgeMessages(LogSource& log, const TypeResolver& resolver);

}  // namespace scoria::logs
