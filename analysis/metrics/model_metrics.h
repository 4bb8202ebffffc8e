// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "logs/row.h"

namespace scoria::analysis {

/// What was learned of the mass since the controller's last start; null where nothing was.
[[nodiscard]] const logs::LearnedModel* FindLearnedModel(const logs::Row& row) noexcept;

/// After this all estimators here have forgotten what was carried before.
inline constexpr double kLate_s = 10.0;

/// A stretch with one true mass, and what was learned of it. Errors are learned minus true.
struct ModelInterval {
  double start_s = 0.0;  // where the change of mass had ended, or learning began
  double duration_s = 0.0;
  double mass_kg = 0.0;     // true, of the whole robot
  double step_kg = 0.0;     // change of the true mass before it; 0 for the first
  double settling_s = 0.0;  // from the beginning of the change; up to the end where not settled
  bool settled = false;     // the last judged row is within the margin
  std::uint64_t rows = 0;   // judged: learned, at work and upright
  double bias_kg = 0.0, rmse_kg = 0.0;            // of the settled part
  double com_x_rmse_m = 0.0, com_y_rmse_m = 0.0;  // of the settled part
  // Of the judged rows from kLate_s after the change on, settled or not.
  std::uint64_t late_rows = 0;
  double late_bias_kg = 0.0, late_noise_kg = 0.0;           // mean, standard deviation
  double late_com_x_bias_m = 0.0, late_com_y_bias_m = 0.0;  // means
  // Standard deviations; results of version 0.1.0 lack them.
  std::optional<double> late_com_x_noise_m = std::nullopt, late_com_y_noise_m = std::nullopt;
  std::uint64_t used_rows = 0;
  double used_bias_kg =
      0.0;  // mean of used minus true, of the settled part or for want of it of all
  bool operator==(const ModelInterval&) const = default;
};

/// Online model adaptation of an episode. Definitions: docs/METRICS.md.
struct ModelMetrics {
  bool present = false;  // an adaptation ran
  std::vector<ModelInterval> intervals;
  bool operator==(const ModelMetrics&) const = default;
};

/// Over the judged intervals of several episodes. All but the shares, the settling time and the
/// used mass are of settled intervals; magnitudes for the biases.
struct ModelSummary {
  int judged = 0, settled = 0, used = 0;  // intervals
  double median_bias_kg = 0.0, p95_bias_kg = 0.0, median_rmse_kg = 0.0;
  double median_settling_s = 0.0;  // one that did not settle counts with its whole duration
  double median_com_x_rmse_m = 0.0, median_com_y_rmse_m = 0.0;
  double median_used_bias_kg = 0.0;
};
[[nodiscard]] ModelSummary SummariseModel(const std::vector<ModelInterval>& intervals);

/// Accumulates rows as they come. What it keeps does not grow with the rows, only with the number
/// of changes of mass.
class ModelAccumulator {
 public:
  /// Rows without the controller's model or the true mass are left out.
  void AddRow(const logs::Row& row);
  /// Ends the open interval.
  [[nodiscard]] ModelMetrics Finish();

 private:
  struct Sums {
    std::uint64_t rows = 0, used_rows = 0;
    double error_kg = 0.0, error_kg2 = 0.0, com_x_m = 0.0, com_y_m = 0.0, com_x_m2 = 0.0,
           com_y_m2 = 0.0, used_kg = 0.0;
    void Add(double mass_error_kg, double com_x_error_m, double com_y_error_m) noexcept;
  };
  void FollowMass(const logs::Row& row);
  void Open(const logs::Row& row, double change_s, double step_kg) noexcept;
  void Close(double end_s);
  void Judge(const logs::Row& row) noexcept;

  ModelMetrics metrics_;
  bool started_ = false, open_ = false;
  bool changed_ = false;  // the mass did, before the open interval
  ModelInterval interval_;
  Sums settled_;  // since the error was last outside the margin
  Sums late_;
  double all_used_kg_ = 0.0;
  std::uint64_t all_used_rows_ = 0;
  double change_s_ = 0.0;        // beginning of the change before the open interval
  double mass_before_kg_ = 0.0;  // and the mass before it
  double last_s_ = 0.0, last_mass_kg_ = 0.0;
};

void to_json(nlohmann::json& j, const ModelMetrics& m);
void from_json(const nlohmann::json& j, ModelMetrics& m);

}  // namespace scoria::analysis
