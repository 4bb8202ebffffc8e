// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace scoria::analysis {

std::string TrajectoryError::Refusal() const {
  if (stretches > 0) return {};
  if (standing == 0) return "the log has no instant with both truth and estimate";
  return fmt::format(
      "the robot stands: by the truth it is never more than {:.2f} m from where it starts, which "
      "tells no yaw to align by",
      largest_distance_m);
}

void TrajectoryErrorAccumulator::Add(const PosePair& now) {
  Stretch& s = stretch_;
  if (s.count++ == 0) s.origin_true = now.p_true, s.origin_est = now.p_est;
  const Vec3 p_true = now.p_true - s.origin_true, p_est = now.p_est - s.origin_est;
  s.sum_true += p_true;
  s.sum_est += p_est;
  s.products += p_true * p_est.transpose();
  s.squares_xy += p_true.head<2>().squaredNorm() + p_est.head<2>().squaredNorm();
  s.squares_z += p_true.z() * p_true.z() + p_est.z() * p_est.z();
  s.largest_distance_m = std::max(s.largest_distance_m, p_true.head<2>().norm());
  drift_.Add(now);
}

void TrajectoryErrorAccumulator::AddRow(const logs::Row& row) {
  const bool walks = !row.episode || (row.episode->operating && !row.episode->fallen);
  const std::uint32_t segment = row.episode ? row.episode->segment : 0;
  if (walks_ && (!walks || segment != segment_)) Break();
  walks_ = walks;
  segment_ = segment;
  if (!walks || !row.truth || !row.estimate) return;
  const auto vector = [](const logs::Array3& v) { return Vec3(v[0], v[1], v[2]); };
  Add({vector(row.truth->p_WB_m), vector(row.estimate->p_WB_m), row.truth->rpy_rad[2],
       row.estimate->rpy_rad[2]});
}

/// With means taken away, the yaw that leaves least turns the sum of true est^T about z as far as
/// it goes: its trace is then the root of the squares of trace and difference.
void TrajectoryErrorAccumulator::Break() {
  drift_.End(false);
  const Stretch s = std::exchange(stretch_, {});
  if (s.count == 0) return;
  error_.largest_distance_m = std::max(error_.largest_distance_m, s.largest_distance_m);
  if (s.largest_distance_m < kLeastDistance_m) {
    ++error_.standing;
    return;
  }
  const auto n = static_cast<double>(s.count);
  const Mat3 C = s.products - s.sum_true * s.sum_est.transpose() / n;
  const double squares_xy =
      s.squares_xy - (s.sum_true.head<2>().squaredNorm() + s.sum_est.head<2>().squaredNorm()) / n;
  const double squares_z =
      s.squares_z - (s.sum_true.z() * s.sum_true.z() + s.sum_est.z() * s.sum_est.z()) / n;
  const double alike_xy = std::hypot(C(0, 0) + C(1, 1), C(1, 0) - C(0, 1));
  sum_horizontal_m2_ += std::max(0.0, squares_xy - 2.0 * alike_xy);
  sum_vertical_m2_ += std::max(0.0, squares_z - 2.0 * C(2, 2));
  error_.samples += s.count;
  ++error_.stretches;
}

TrajectoryError TrajectoryErrorAccumulator::Finish() {
  Break();
  TrajectoryError out = error_;
  if (out.samples == 0) return out;
  const auto n = static_cast<double>(out.samples);
  out.ate_horizontal_m = std::sqrt(sum_horizontal_m2_ / n);
  out.ate_vertical_m = std::sqrt(sum_vertical_m2_ / n);
  out.ate_m = std::hypot(out.ate_horizontal_m, out.ate_vertical_m);
  out.rpe_1m = drift_.rpe_1m();
  out.rpe_10m = drift_.rpe_10m();
  return out;
}

void to_json(nlohmann::json& j, const TrajectoryError& e) {
  if (const std::string refusal = e.Refusal(); !refusal.empty()) {
    j = {{"refusal", refusal}};
    return;
  }
  j = {{"samples", e.samples},
       {"stretches", e.stretches},
       {"standing_stretches", e.standing},
       {"ate_m", e.ate_m},
       {"ate_horizontal_m", e.ate_horizontal_m},
       {"ate_vertical_m", e.ate_vertical_m},
       {"rpe_1m", e.rpe_1m},
       {"rpe_10m", e.rpe_10m}};
}

}  // namespace scoria::analysis
