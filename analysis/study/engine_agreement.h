// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/statistics/ratio_of_ratios.h"
#include "analysis/study/compare.h"
#include "analysis/study/metric_differences.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// Key of the axis along which engines are swept.
inline constexpr std::string_view kEngineKey = "physics.engine.type";

/// One arm in two engines, in pairs of the same seed and point of the rest of the sweep.
struct ArmInEngines {
  std::string arm;
  std::vector<std::string> point;  // without the engine; empty: over the whole sweep
  Comparison falls;                // of the engine (a) against the reference (b)
  ArmDifferences metrics;          // engine minus reference
};

/// Two arms, compared in either engine.
struct VerdictInEngines {
  Comparison in_engine, in_reference;
  std::vector<std::string> point;  // likewise
  RatioOfRatios ratios;  // of falls per metre: that of the engine to that of the reference
};

/// Does what a campaign finds hold in both of its physics engines?
struct EngineAgreement {
  std::string engine, reference;
  std::vector<Axis> axes;  // without the engine
  std::vector<ArmInEngines> arms;
  std::vector<VerdictInEngines> verdicts;  // none of a single arm
};

/// Of the first two engines of the sweep; the axis' baseline, or its first value, is the reference.
/// @returns nothing where `physics.engine.type` is not swept.
[[nodiscard]] std::optional<EngineAgreement> CompareEngines(const CampaignResults& results,
                                                            const Metrics& metrics);

/// "ags falls less in bullet than in scoria: 3 in 600 m and 12 in 600 m, rate ratio ...", or that
/// it is not shown.
[[nodiscard]] std::string FallsInEngines(const EngineAgreement& agreement, const ArmInEngines& arm);

/// "velocity RMSE [mm/s] of ags is larger in bullet: 5.1 in bullet, 4.8 in scoria, difference +0.3
/// (95 %: +0.1 to +0.5)", or that no difference is shown. Empty where no pair has the metric.
[[nodiscard]] std::string MetricInEngines(const EngineAgreement& agreement, const ArmInEngines& arm,
                                          std::string_view key);

/// Whether the verdict on two arms depends on the engine, with both rate ratios and their ratio.
[[nodiscard]] std::string VerdictsInEngines(const EngineAgreement& agreement,
                                            const VerdictInEngines& verdict);

}  // namespace scoria::analysis
