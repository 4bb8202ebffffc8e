// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "logs/mapping/mapping.h"
#include "logs/quality/finding.h"

namespace scoria::app {

/// What accepting findings changes of how a log is read.
struct Accepted {
  std::optional<logs::Mapping> mapping;  // with the repairs; none: as it was
  std::vector<logs::TimeSpan> left_out;  // rows that are not read
  std::vector<std::string> remarks;      // what was done, a sentence each
};

/// Accepts every finding of the kinds: a repair that is a key of the mapping with its value is made
/// there; of others the spans are left out.
/// @param kinds    names of FindingKind.
/// @param mapping  that the log is read by; null: it has rows of its own.
/// Errors: std::runtime_error for a name that is none, and for a finding that is accepted but has
/// neither such a repair nor spans; ConfigError where the mapping refuses the repair.
[[nodiscard]] Accepted Accept(const std::vector<std::string>& kinds,
                              const std::vector<logs::Finding>& findings,
                              const logs::Mapping* mapping);

}  // namespace scoria::app
