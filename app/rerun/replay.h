// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/metrics/estimation_metrics.h"
#include "logs/row.h"

namespace scoria::app {

struct ReplayResult {
  std::int64_t steps = 0, rows = 0;  // replayed; compared
  bool identical = true;             // every estimate has the bits of the log's
  double first_difference_s = 0.0;   // if not
  analysis::EstimationMetrics logged, replayed;
  logs::RowGroups groups;    // that the compared rows had
  std::string file_problem;  // where the log is damaged
};

/// Feeds the inputs that a log holds to a controller once more, and compares what it believes with
/// what the log says it believed. Overrides of `controller.*` ask what another estimator would have
/// believed on the same walk.
/// Errors: std::runtime_error if the log lacks the inputs; core::ConfigError for an override.
[[nodiscard]] ReplayResult ReplayLog(const std::filesystem::path& log,
                                     const std::vector<std::string>& overrides);

}  // namespace scoria::app
