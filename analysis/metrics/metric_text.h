// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/registry.h"

namespace scoria::analysis {

/// The unit of the numbers that are shown.
[[nodiscard]] std::string_view ShownUnit(const MetricInfo& info) noexcept;

/// "height RMSE [mm]"; the title alone of a number without a unit.
[[nodiscard]] std::string TitleWithUnit(const MetricInfo& info);

/// "3.1", in the unit that is shown.
[[nodiscard]] std::string ShownNumber(const MetricInfo& info, double value);

/// "height RMSE, roll RMSE: not valid here: the log has no truth": a line for each set of groups
/// that `had` lacks. Empty where nothing is missing.
[[nodiscard]] std::vector<std::string> DescribeNotValid(const Metrics& metrics,
                                                        const std::optional<logs::RowGroups>& had,
                                                        const Substitutes& substitutes = {});

/// What was measured of an episode, a paragraph for each family, then what is not valid. Lines are
/// indented by two and end with a newline.
[[nodiscard]] std::string DescribeMetrics(const Metrics& metrics, const EpisodeMetrics& m);

/// The metrics as the table of docs/METRICS.md.
[[nodiscard]] std::string MetricsMarkdown(const Metrics& metrics);

}  // namespace scoria::analysis
