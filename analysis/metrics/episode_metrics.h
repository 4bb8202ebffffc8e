// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/metrics/metric.h"
#include "analysis/metrics/model_metrics.h"
#include "analysis/metrics/time_quantiles.h"
#include "analysis/metrics/tracking_errors.h"
#include "analysis/signals/falls.h"
#include "analysis/signals/gait_timing.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Energy drawn over a stretch of walking.
struct Energy {
  double mech_abs_J = 0.0, mech_pos_J = 0.0, electrical_J = 0.0, battery_J = 0.0;
  Energy& operator+=(const Energy& other) noexcept;
};
[[nodiscard]] Energy operator-(const Energy& a, const Energy& b) noexcept;

/// Where the motors' net work went over the whole episode, summed over the stretches between
/// placements: motor + external + joint + contact = stored + error, losses being negative works.
struct EnergyBudget {
  double motor_J = 0.0, joint_J = 0.0, contact_J = 0.0, external_J = 0.0, stored_J = 0.0;
  double error_J = 0.0;  // sum of magnitudes: what the integrator made or lost
  EnergyBudget& operator+=(const EnergyBudget& other) noexcept;
};

/// Episodes that went less, standing and turning in place, have no cost of transport.
inline constexpr double kLeastWay_m = 1.0;

/// Cost of transport, by how the energy is counted: energy over ∫ m g ds.
struct CostOfTransport {
  double mech_abs = 0.0, mech_pos = 0.0, electrical = 0.0, battery = 0.0;
};

/// Cost of transport of one steady window: energy over ∫ m g ds. What counts as steady: METRICS.md.
struct SpeedWindow {
  double v_mps = 0.0;  // distance over time
  double command_mps = 0.0;
  double cot_mech_abs = 0.0, cot_mech_pos = 0.0, cot_electrical = 0.0;
};

/// What only the program that ran an episode counts, or that analysed a log.
struct EpisodeOutcome {
  int falls = 0;
  std::optional<int> stuck;                // nobody counted it in a log of a robot
  std::optional<double> real_time_factor;  // of a simulation
};

/// Everything measured of one episode, or of several added up. Numbers that are shown come from
/// here through the registry (registry.h), which says where they were not measured. Definitions:
/// docs/METRICS.md.
struct EpisodeMetrics {
  int episodes = 1;                       // added up
  std::optional<logs::RowGroups> groups;  // that rows had; unknown: older results
  Substitutes substitutes;                // for groups that a robot's log lacks
  /// By key, why a number is not given although the rows had its groups: "no battery current".
  std::map<std::string, std::string, std::less<>> withheld;
  std::optional<EpisodeOutcome> outcome;  // none where nobody counted
  double duration_s = 0.0, walking_s = 0.0;
  double distance_m = 0.0;        // half-second chords of the trunk's path, placements excluded
  std::optional<double> mass_kg;  // of the last row
  double transport_J = 0.0;  // ∫ m g ds over the distance: what cost of transport is relative to
  Energy energy;             // while walking
  EnergyBudget budget;
  std::optional<CostOfTransport> cot;
  std::vector<SpeedWindow> windows;
  TrackingErrors tracking;
  TimeQuantiles mpc, wbc;
  std::optional<double> peak_foot_force_N;
  std::vector<FallEvent> falls;
  std::optional<double>
      first_fall_m;  // distance walked before the first fall; of older results none
  EstimationMetrics estimation;
  ModelMetrics model;
  GaitTiming gait;
  std::map<std::string, Measured> measured;  // by RowMetrics, by key

  /// Adds another episode's energy, way, falls, contacts, segments and intervals; what does not add
  /// up (means, quantiles, windows) is left as it is: the registry pools it.
  EpisodeMetrics& operator+=(const EpisodeMetrics& other);
};

/// Nothing without ∫ m g ds, or where less than kLeastWay_m was walked in the mean of the episodes.
[[nodiscard]] std::optional<CostOfTransport> CalcCostOfTransport(const EpisodeMetrics& m) noexcept;

/// What was not measured is null. Results of older versions are read, too: they do not say which
/// groups their rows had, and their zeros of what an episode cannot have exactly are absent values.
void to_json(nlohmann::json& j, const EpisodeMetrics& m);
void from_json(const nlohmann::json& j, EpisodeMetrics& m);

}  // namespace scoria::analysis
