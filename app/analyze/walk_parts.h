// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/metrics/metrics.h"
#include "app/analyze/read_series.h"

namespace scoria::app {

/// Measures what was walked under each gait sequencer and at each commanded speed, in steps of
/// 0.1 m/s, by the same metrics as the whole.
class WalkParts {
 public:
  struct Part {
    std::string sequencer;
    double command_mps = 0.0;
    analysis::EpisodeMetrics metrics;
  };

  /// @param sequencer  where it changes; empty: the log does not say.
  WalkParts(Series sequencer, double gravity_mps2);

  /// @param num_falls  so far.
  void AddRow(const logs::Row& row, const logs::RowGroups& stand_ins,
              const std::vector<analysis::FallEvent>& falls);

  /// Those that have walked, by sequencer and speed.
  [[nodiscard]] std::vector<Part> Finish();

 private:
  using Key = std::pair<std::string, int>;  // sequencer, speed in 0.1 m/s
  [[nodiscard]] Key KeyOf(const logs::Row& row);

  Series sequencer_;
  std::size_t next_change_ = 0;
  double gravity_mps2_;
  std::map<Key, analysis::MetricsAccumulator> parts_;
  std::map<Key, int> falls_;
  std::size_t falls_seen_ = 0;
  std::optional<Key> current_;
};

}  // namespace scoria::app
