// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/metrics/estimation_metrics.h"
#include "logs/row.h"

namespace scoria::app {

/// A paragraph on stdout: drift, errors, consistency and contacts of an estimator, and what the
/// rows do not give.
/// @param groups  that the rows had.
void PrintEstimation(const char* what, const analysis::EstimationMetrics& estimation,
                     const logs::RowGroups& groups);

}  // namespace scoria::app
