// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "analysis/study/compare.h"
#include "analysis/study/metric_differences.h"

namespace scoria::analysis {

/// "WHERE: ags falls less than sgs: ags fell once in 300 m, ...", or that there is no evidence.
[[nodiscard]] std::string FallVerdict(const Comparison& c, const std::string& where);

/// One sentence for all comparisons of a place that show no difference: "WHERE: no evidence that
/// ags falls more or less than sgs (rate ratio 0.92, 95 %: 0.41 to 2.04), ...". Empty for none of
/// them.
[[nodiscard]] std::string NoEvidenceVerdict(std::span<const Comparison> comparisons,
                                            const std::string& where);

/// "b against a: better in height RMSE; worse in nothing; no evidence of a difference in 31 other
/// metrics (5 %, Holm)." Metrics without a better direction are left out. Empty without any.
[[nodiscard]] std::string MetricVerdict(const ArmDifferences& d);

}  // namespace scoria::analysis
