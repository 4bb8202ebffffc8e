// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/registry.h"
#include "analysis/signals/path.h"
#include "analysis/signals/steady.h"
#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Accumulates rows as they come, from an episode or from a log. What a row lacks is not measured
/// of it.
class MetricsAccumulator {
 public:
  /// @param metrics  whose own accumulators take the rows, too.
  explicit MetricsAccumulator(double gravity_mps2, const Metrics& metrics = AllMetrics());
  void AddRow(const logs::Row& row) { AddRow(row, {}); }
  /// @param stand_ins  groups of the row that stand in for what a robot's log lacks: metrics that
  /// do not take them are measured without.
  void AddRow(const logs::Row& row, const logs::RowGroups& stand_ins);
  void AddFall(const FallEvent& fall) { metrics_.falls.push_back(fall); }
  [[nodiscard]] EpisodeMetrics Finish();

 private:
  struct Own {
    std::string key;
    logs::RowGroups needs;
    bool takes_substitutes = false;
    std::unique_ptr<RowMetric> accumulator;
  };
  struct Place {
    double time_s = 0.0;
    Vec2 p_W = Vec2::Zero();
  };
  void AddOwn(const logs::Row& row, bool with_stand_ins);
  void AddEpisode(const logs::Row& row);
  void AddTimes(const logs::SolveTimesRow& times);
  void AddPeakForce(const logs::TrueContactsRow& contacts);
  void AddWalking(const logs::Row& row);
  void AddEnergy(const logs::EnergyRow& energy);
  void AddPath(const logs::Row& row);
  void AddWindow(const logs::Row& row, double dt_s);
  void StartStretch(const logs::Row& row);
  void StartSteady(const logs::Row& row);
  void AddChord(double chord_m, double end_s);
  void StartWindow(const logs::Row& row);
  void NoteFirstFall();
  void DropWindowBefore(double fall_s);
  void EndStretch();
  void CloseBudget();

  double gravity_mps2_;
  EpisodeMetrics metrics_;
  logs::RowGroups groups_;
  std::vector<Own> own_;
  // Of the stretch between a placement and a fall.
  bool in_stretch_ = false;
  std::uint32_t segment_ = 0;
  double last_s_ = 0.0;
  std::optional<Energy> last_energy_;
  std::optional<Place> last_place_;
  PathLength path_;
  double chord_start_s_ = 0.0, chord_mass_kgs_ = 0.0;  // of the open chord: start, ∫ m dt
  std::optional<double> last_mass_kg_;
  SteadyCommand command_;
  SteadyWindows windows_;
  std::optional<Energy> window_energy_;  // at the start of the open window
  double window_transport_J_ = 0.0;
  std::optional<double> last_window_s_;  // end of the last one of this stretch
  TrackingAccumulator tracking_;
  TimeHistogram mpc_times_, wbc_times_;
  EstimationAccumulator estimation_;
  ModelAccumulator model_;
  GaitTimer gait_;
  std::optional<std::uint32_t> last_segment_;  // of any row
  std::optional<logs::LedgerRow> ledger_;      // of the last row
};

}  // namespace scoria::analysis
