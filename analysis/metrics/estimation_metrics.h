// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/contact_metrics.h"
#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Estimated minus true height of the trunk, m: what to add to a true height before it is compared
/// with a reference in the estimator's frame. None without estimate or truth.
[[nodiscard]] std::optional<double> HeightDrift(const logs::Row& row) noexcept;

/// A point that the controller named in the estimator's frame, where it truly meant it: as seen
/// from the trunk. None without estimate or truth.
[[nodiscard]] std::optional<Vec3> FromEstimatorFrame(const logs::Row& row,
                                                     const Vec3& p_W_est) noexcept;

/// Normalised estimation error squared of tilt and velocity, χ² of 5 degrees of freedom for a
/// consistent filter. The velocity's error is right-invariant, so it is that of the body velocity,
/// turned into W. None without truth or a covariance.
[[nodiscard]] std::optional<double> CalcNees(const logs::Row& row);

/// What the estimate lost over one stretch of walking between placements and falls, with the
/// start's offset of place and yaw removed. Errors are estimated minus true.
struct DriftSegment {
  double distance_m = 0.0;
  double horizontal_pct = 0.0;  // of the distance, >= 0
  double vertical_pct = 0.0;    // of the distance, signed
  double yaw_deg_per_m = 0.0;   // signed
};

/// Medians over segments, magnitudes for the signed numbers.
struct DriftSummary {
  int segments = 0;         // that the medians are of
  int short_segments = 0;   // walked less than the least distance
  bool used_short = false;  // for want of longer ones
  double distance_m = 0.0;  // of the segments used, together
  double horizontal_pct = 0.0, vertical_pct = 0.0, yaw_deg_per_m = 0.0;
};

/// Relative pose error: root mean squares over stretches of a fixed length of path.
struct RelativePoseError {
  std::uint64_t stretches = 0;
  double horizontal_rms_m = 0.0, vertical_rms_m = 0.0;
  RelativePoseError& operator+=(const RelativePoseError& other) noexcept;
};

/// State estimation and contact detection of an episode, or of several added up. Definitions:
/// docs/METRICS.md.
struct EstimationMetrics {
  bool present = false;                // an estimate other than the truth, or a filter's
  std::vector<DriftSegment> segments;  // of a metre or more
  int stub_segments = 0;               // of less
  RelativePoseError rpe_1m, rpe_10m;
  std::uint64_t rows = 0;
  double velocity_rmse_mps = 0.0, roll_rmse_rad = 0.0, pitch_rmse_rad = 0.0;
  double nees_ratio = 0.0;  // mean NEES over its 5 degrees of freedom: 1 when consistent
  std::uint64_t nees_rows = 0;
  double nis_ratio = 0.0;  // sum of NIS over sum of degrees of freedom: 1 when consistent
  std::uint64_t nis_rows = 0, nis_dof = 0;
  // Vertical force of the observer against the truth, rows of legs in true stance and swing.
  double force_stance_rmse_N = 0.0, force_swing_rmse_N = 0.0;
  std::uint64_t force_stance_rows = 0, force_swing_rows = 0;
  ContactMetrics contact;

  EstimationMetrics& operator+=(const EstimationMetrics& other);
};

inline constexpr double kMinSegment_m = 20.0;
[[nodiscard]] DriftSummary SummariseDrift(const EstimationMetrics& m,
                                          double min_segment_m = kMinSegment_m);

/// Truth and estimate of one instant, each in its own frame.
struct PosePair {
  Vec3 p_true = Vec3::Zero(), p_est = Vec3::Zero();
  double yaw_true_rad = 0.0, yaw_est_rad = 0.0;
};

/// Follows truth and estimate along the path. The path is measured in chords of 0.1 m, which the
/// trunk's sway does not lengthen; marks every 0.5 m begin and end the stretches of the relative
/// pose errors.
class DriftTracker {
 public:
  void Add(const PosePair& now) noexcept;
  /// Ends the segment. Before a fall the path since the last mark but one is left out: the tumble
  /// is not walking.
  void End(bool fell);
  [[nodiscard]] const std::vector<DriftSegment>& segments() const { return segments_; }
  [[nodiscard]] int stub_segments() const { return stub_segments_; }
  [[nodiscard]] RelativePoseError rpe_1m() const noexcept { return ErrorOf(stretches_[0]); }
  [[nodiscard]] RelativePoseError rpe_10m() const noexcept { return ErrorOf(stretches_[1]); }

 private:
  struct Mark {
    PosePair pose;
    double path_m = 0.0;
  };
  struct Stretches {
    double length_m = 0.0;
    std::size_t next = 0;  // mark at which the next stretch begins
    double sum_horizontal_m2 = 0.0, sum_vertical_m2 = 0.0;
    std::uint64_t count = 0;
  };
  static constexpr std::size_t kMarks = 32;  // more than 10 m of them
  [[nodiscard]] static RelativePoseError ErrorOf(const Stretches& s) noexcept;
  [[nodiscard]] Mark& MarkAt(std::size_t number) noexcept { return marks_[number % kMarks]; }
  void PushMark(const PosePair& now) noexcept;
  void EndStretchesAt(const Mark& end) noexcept;
  void Reset() noexcept;

  bool active_ = false;
  PosePair start_, chord_, last_;
  double path_m_ = 0.0;
  std::array<Mark, kMarks> marks_{};
  std::size_t num_marks_ = 0;
  std::array<Stretches, 2> stretches_{{{.length_m = 1.0}, {.length_m = 10.0}}};
  std::vector<DriftSegment> segments_;
  int stub_segments_ = 0;
};

/// Accumulates rows as they come. What it keeps does not grow with the rows, only with the number
/// of placements.
class EstimationAccumulator {
 public:
  void AddRow(const logs::Row& row);
  /// Ends the open segment.
  [[nodiscard]] EstimationMetrics Finish();

 private:
  struct MeanSquare {
    double sum = 0.0;
    std::uint64_t count = 0;
    void Add(double error) noexcept;
    [[nodiscard]] double Root() const noexcept;
  };
  void AddErrors(const logs::TruthRow& truth, const logs::EstimateRow& estimate) noexcept;
  void AddConsistency(const logs::Row& row) noexcept;
  void AddForces(const logs::TrueContactsRow& truth, const logs::Array12& f_F_W_N) noexcept;

  bool walking_ = false;
  std::uint32_t segment_ = 0;
  bool present_ = false;
  DriftTracker drift_;
  ContactAccumulator contact_;
  MeanSquare velocity_, roll_, pitch_, force_stance_, force_swing_;
  double sum_nees_ = 0.0, sum_nis_ = 0.0;
  std::uint64_t nees_rows_ = 0, nis_rows_ = 0, nis_dof_ = 0;
};

void to_json(nlohmann::json& j, const RelativePoseError& e);
void to_json(nlohmann::json& j, const EstimationMetrics& m);
void from_json(const nlohmann::json& j, EstimationMetrics& m);

}  // namespace scoria::analysis
