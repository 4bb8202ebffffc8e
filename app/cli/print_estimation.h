// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/metrics/estimation_metrics.h"

namespace scoria::app {

/// One line on standard output: drift, velocity, attitude and contact of an estimate.
void PrintEstimation(const char* what, const analysis::EstimationMetrics& metrics);

}  // namespace scoria::app
