// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/report/section.h"

namespace scoria::analysis {

[[nodiscard]] Section QualitySection();
[[nodiscard]] Section FieldLogsSection();
[[nodiscard]] Section PointVerdictsSection();
[[nodiscard]] Section RateRatiosSection();
[[nodiscard]] Section EnginesSection();
[[nodiscard]] Section SurvivalSection();
[[nodiscard]] Section FactorsSection();
[[nodiscard]] Section FailuresSection();
[[nodiscard]] Section FallsSection();
[[nodiscard]] Section CostOfTransportSection();
[[nodiscard]] Section TrackingSection();
[[nodiscard]] Section NumbersSection();
[[nodiscard]] Section DifferencesSection();
[[nodiscard]] Section StateEstimationSection();
[[nodiscard]] Section ContactDetectionSection();
[[nodiscard]] Section ModelAdaptationSection();
[[nodiscard]] Section BiasBudgetSection();
[[nodiscard]] Section AdaptedTrackingSection();
[[nodiscard]] Section EnergySection();
[[nodiscard]] Section ComputingTimeSection();
[[nodiscard]] Section GroundSection();
[[nodiscard]] Section CourseSection();
[[nodiscard]] Section VideosSection();
[[nodiscard]] Section DataSection();

/// Those that only reports of robots' logs have; they come first.
[[nodiscard]] std::vector<Section> FieldSections();

/// All others, in the order of the page.
[[nodiscard]] std::vector<Section> AllSections();

}  // namespace scoria::analysis
