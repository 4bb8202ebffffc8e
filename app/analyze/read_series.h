// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/analyze/log_rows.h"

namespace scoria::app {

/// A number of the messages of a topic over time.
struct SeriesSample {
  double time_s = 0.0;  // of the rows
  double value = 0.0;
};
using Series = std::vector<SeriesSample>;

/// What rows do not hold of the reference framework's topics.
struct ReferenceSeries {
  Series sequencer;    // /gait_state: where it changes; as GaitState has it
  Series cpu_power_W;  // /cpu_power_consumption
};

/// Reads them; empty where the log has no such topics.
/// @param first_row_s  time of the first row.
/// @param base_topic   whose messages are the rows; empty: times of recording are those of the
/// rows. Errors: core::FileError.
[[nodiscard]] ReferenceSeries ReadReferenceSeries(const LogRows& rows, double first_row_s,
                                                  const std::string& base_topic);

/// "simple", "adaptive" or "bio-inspired".
[[nodiscard]] std::string SequencerName(double value);

}  // namespace scoria::app
