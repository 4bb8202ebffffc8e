// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "analysis/metrics/metric.h"

namespace scoria::analysis {

/// Each family's metrics. A metric of a file of its own is declared below them.
[[nodiscard]] Metrics SafetyMetrics();
[[nodiscard]] Metrics TransportMetrics();
[[nodiscard]] Metrics TrackingMetrics();
[[nodiscard]] Metrics EstimationFamilyMetrics();
[[nodiscard]] Metrics ContactFamilyMetrics();
[[nodiscard]] Metrics ModelFamilyMetrics();
[[nodiscard]] Metrics EnergyMetrics();
[[nodiscard]] Metrics TimingMetrics();
[[nodiscard]] Metrics GaitMetrics();
/// Of the family of energy.
[[nodiscard]] Metrics EffortMetrics();
/// Of several families: what needs no truth.
[[nodiscard]] Metrics FieldMetrics();

[[nodiscard]] Metric FallbackShareMetric();

/// The value if it was measured, for Metric::find.
[[nodiscard]] inline std::optional<Measured> MeasuredIf(bool measured, double value,
                                                        double weight = 1.0) {
  return measured ? std::optional(Measured{value, weight}) : std::nullopt;
}

}  // namespace scoria::analysis
