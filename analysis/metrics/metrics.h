// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/metrics/model_metrics.h"
#include "analysis/signals/falls.h"
#include "analysis/signals/path.h"
#include "analysis/signals/steady.h"
#include "analysis/signals/stride_mean.h"
#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Energy drawn over a stretch of walking.
struct Energy {
  double mech_abs_J = 0.0, mech_pos_J = 0.0, electrical_J = 0.0, battery_J = 0.0;
};

/// Where the motors' net work went over the whole episode, summed over the stretches between
/// placements: motor + external + joint + contact = stored + error, losses being negative works.
struct EnergyBudget {
  double motor_J = 0.0, joint_J = 0.0, contact_J = 0.0, external_J = 0.0, stored_J = 0.0;
  double error_J = 0.0;  // sum of magnitudes: what the integrator made or lost
};

/// Episodes that went less, standing and turning in place, have no cost of transport.
inline constexpr double kLeastWay_m = 1.0;

/// Cost of transport of one steady window: energy over ∫ m g ds. What counts as steady: METRICS.md.
struct SpeedWindow {
  double v_mps = 0.0;  // distance over time
  double command_mps = 0.0;
  double cot_mech_abs = 0.0, cot_mech_pos = 0.0, cot_electrical = 0.0;
};

/// Root mean squares of tracking errors over steady walking (three seconds after the command
/// changed, or later).
struct TrackingErrors {
  double samples_s = 0.0;
  double velocity_rmse_mps = 0.0;  // horizontal, averaged over a stride first
  double velocity_x_mps = 0.0, velocity_y_mps = 0.0, yaw_rate_radps = 0.0;  // means in H
  double command_x_mps = 0.0, command_y_mps = 0.0, command_yaw_radps = 0.0;
  double height_rmse_m = 0.0;                        // COM against the reference
  double roll_rmse_rad = 0.0, pitch_rmse_rad = 0.0;  // against the reference
  double drift_m = 0.0;                              // largest distance from where standing began
};

struct TimeQuantiles {
  double median_s = 0.0, p99_s = 0.0, max_s = 0.0;
  int count = 0;
};

/// Counts durations in bins one per cent wide, so that a day of walking takes no more room than a
/// minute.
class TimeHistogram {
 public:
  void Add(double time_s);
  [[nodiscard]] TimeQuantiles Summarise() const;

 private:
  static constexpr double kShortest_s = 1e-8, kWidth = 0.01;  // of the logarithm
  static constexpr std::size_t kBins = 2303;                  // up to 100 s
  std::array<long, kBins> counts_{};
  double longest_s_ = 0.0;
  long count_ = 0;
};

/// Everything reported of one episode. Definitions: docs/METRICS.md.
struct EpisodeMetrics {
  double duration_s = 0.0, walking_s = 0.0;
  double distance_m = 0.0;   // half-second chords of the trunk's path, placements excluded
  double mass_kg = 0.0;      // of the last row
  double transport_J = 0.0;  // ∫ m g ds over the distance: what cost of transport is relative to
  Energy energy;             // while walking
  EnergyBudget budget;
  double cot_mech_abs = 0.0, cot_mech_pos = 0.0, cot_electrical = 0.0, cot_battery = 0.0;
  std::vector<SpeedWindow> windows;
  TrackingErrors tracking;
  TimeQuantiles mpc, wbc;
  double peak_foot_force_N = 0.0;
  std::vector<FallEvent> falls;
  EstimationMetrics estimation;
  ModelMetrics model;
};

/// Accumulates rows as they come, from an episode or from a log.
class MetricsAccumulator {
 public:
  explicit MetricsAccumulator(double gravity_mps2) : gravity_mps2_(gravity_mps2) {}
  void AddRow(const logs::Row& row);
  void AddFall(const FallEvent& fall) { metrics_.falls.push_back(fall); }
  [[nodiscard]] EpisodeMetrics Finish();

 private:
  [[nodiscard]] static Energy EnergyOf(const logs::Row& row);
  void AddTimes(const logs::SolveTimesRow& times);
  void AddPeakForce(const logs::TrueContactsRow& contacts);
  void AddWhole(const logs::Row& row);
  void AddWalking(const logs::Row& row);
  void AddWindow(const logs::Row& row);
  void AddTracking(const logs::Row& row);
  void StartStretch(const logs::Row& row);
  void StartSteady(const logs::Row& row);
  void AddChord(double chord_m, const logs::Row& row);
  void StartWindow(const logs::Row& row);
  void DropWindowBefore(double fall_s);
  void EndStretch();
  void CloseBudget();

  double gravity_mps2_;
  EpisodeMetrics metrics_;
  bool in_stretch_ = false;
  std::uint32_t segment_ = 0;
  logs::Row previous_;
  PathLength path_;
  double chord_start_s_ = 0.0, chord_mass_kgs_ = 0.0;  // of the open chord: start, ∫ m dt
  SteadyCommand command_;
  SteadyWindows windows_;
  Energy window_energy_;  // at the start of the open window
  double window_transport_J_ = 0.0;
  double last_window_s_ = -1.0;  // end of the last one of this stretch
  std::optional<Vec2> stand_W_;  // where steady standing began
  StrideMean stride_;            // of the velocity's error
  double sum_velocity_ = 0.0, sum_height_ = 0.0, sum_roll_ = 0.0, sum_pitch_ = 0.0;
  long rows_ = 0, stride_rows_ = 0;
  TimeHistogram mpc_times_, wbc_times_;
  EstimationAccumulator estimation_;
  ModelAccumulator model_;
  std::optional<std::uint32_t> last_segment_;  // of any row
  std::optional<logs::LedgerRow> ledger_;      // of the last row
};

void to_json(nlohmann::json& j, const EpisodeMetrics& m);
void from_json(const nlohmann::json& j, EpisodeMetrics& m);

}  // namespace scoria::analysis
