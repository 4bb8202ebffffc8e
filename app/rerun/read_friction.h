// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/analyze/analyze_log.h"

namespace scoria::app {

/// How far feet slip: the way that 95 % of a log's stances slip less than. More the less friction,
/// and the rougher the ground; the tail tells frictions apart best. None where the log does not
/// tell slips, or of fewer than 40 stances.
/// Errors: as AnalyzeLog.
[[nodiscard]] std::optional<double> SlipOf(const std::filesystem::path& log,
                                           const AnalyzeOptions& options);

/// How far feet slip on a friction, in walks of a draft.
struct SlipOnFriction {
  double friction = 0.0, slip_m = 0.0;
};

/// Walks a drafted scenario on several frictions, three seeds each, and reads the logs with the
/// same eyes as that of the robot; the geometric means of their slips count. A walk lasts 30 s at
/// most and ends at its first fall.
/// @param draft  its YAML.
/// @returns by rising friction, those on which it walks far enough.
/// Errors: core::ConfigError of the draft; core::FileError for a temporary file.
[[nodiscard]] std::vector<SlipOnFriction> WalkFrictions(const std::filesystem::path& draft);

/// The friction on which feet slip as far, between those that were walked and a little beyond: by
/// straight lines of logarithms. None where frictions slip alike.
/// @param walked  by rising friction.
[[nodiscard]] std::optional<double> ReadFriction(const std::vector<SlipOnFriction>& walked,
                                                 double slip_m);

}  // namespace scoria::app
