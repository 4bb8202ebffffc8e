// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "logs/format/log_source.h"
#include "logs/mapping/mapping.h"

namespace scoria::logs {

/// A log that no mapping fits, or two.
struct MappingChoiceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The mapping that fits a log by topics, types and columns: all that are not optional are there.
/// Of several the one that gives most signals.
/// @param mappings  to choose from, as ShippedMappings().
/// Errors: MappingChoiceError by the log's path, if none fits or two fit equally.
[[nodiscard]] const Mapping& ChooseMapping(const LogContents& contents,
                                           std::span<const Mapping> mappings);

}  // namespace scoria::logs
