// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/metrics/metric.h"

namespace scoria::analysis {

/// The example of docs/add_a_metric.md.
[[nodiscard]] Metric PeakCurrentMetric();

}  // namespace scoria::analysis
