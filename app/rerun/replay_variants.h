// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/field/estimate_consistency.h"
#include "analysis/field/trajectory_error.h"
#include "analysis/metrics/estimation_metrics.h"
#include "app/rerun/log_inputs.h"

namespace scoria::app {

/// What is asked of a log: the estimation of its controller with keys changed.
struct Variant {
  std::string name;
  std::vector<std::string> set;  // as "controller.estimator.type=linear_kf"
};

/// Reads "NAME=key=value,key=value"; commas within braces and brackets belong to the value.
/// Errors: core::ConfigError.
[[nodiscard]] Variant ParseVariant(const std::string& text);

/// Where the estimates go, beside their scores.
struct ReplayOutputs {
  std::filesystem::path log = {};  // MCAP: the log's rows and each variant's, by name; empty: none
  std::filesystem::path tum = {};  // folder of trajectories as evo reads them; empty: none
  bool force = false;              // overwrite files that are there
};

/// A learned mass of the whole robot: its mean over the second half of the log.
struct LearnedMass {
  double mass_kg = 0.0, sigma_kg = 0.0;
  bool tared = false;  // or no tare asked for
};

/// What a variant made of the log.
struct VariantResult {
  std::string name;
  std::vector<std::string> set, remarks;
  bool started_in_motion = false;
  std::uint64_t gaps = 0;
  analysis::EstimationMetrics estimation;  // against the log's truth, and of innovations
  logs::RowGroups groups;                  // that the scored rows had
  analysis::TrajectoryError trajectory;    // after alignment by yaw and translation
  analysis::EstimateConsistency consistency;
  std::optional<LearnedMass> mass;
  /// What the vertical forces on all feet carry, by the momentum observer: a mean over the same
  /// time.
  std::optional<double> feet_carry_kg;
};

struct ReplayReport {
  LogInputs inputs;
  std::optional<analysis::EstimationMetrics> logged;  // of the log's own estimate
  logs::RowGroups logged_groups;
  std::optional<analysis::TrajectoryError> logged_trajectory;
  std::vector<VariantResult> variants;
  std::vector<std::filesystem::path> files;  // that were written
};

/// Estimates again on the rows of a log of any origin, all variants side by side in one pass (after
/// one that surveys the log) and on all cores. No planner and no command is replayed: what is asked
/// is what another estimator, contact detection or adaptation would have found on the same samples.
/// @param workers  threads at most.
/// Errors: as SurveyInputs and SetUpVariant, with the variant's name; core::FileError.
[[nodiscard]] ReplayReport ReplayVariants(const LogInputOptions& options,
                                          const std::vector<Variant>& variants,
                                          const ReplayOutputs& outputs, int workers);

}  // namespace scoria::app
