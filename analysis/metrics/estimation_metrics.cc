// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/estimation_metrics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "core/math/angles.h"
#include "core/math/so3.h"
#include "logs/vectors.h"

namespace scoria::analysis {
namespace {

constexpr double kChord_m = 0.1, kMark_m = 0.5;
constexpr double kRounding_m = 1e-9;     // of sums of chords
constexpr double kLeastSegment_m = 1.0;  // below, a share of the distance says nothing
constexpr double kNeesDof = 5.0;         // roll, pitch, body velocity

/// Of the estimate over a stretch of path, in the heading at its start: each in its own.
struct StretchError {
  Vec3 p_m = Vec3::Zero();
  double yaw_rad = 0.0;
};

StretchError CalcStretchError(const PosePair& from, const PosePair& to) {
  const Vec3 moved_true = core::RotationZ(-from.yaw_true_rad) * (to.p_true - from.p_true);
  const Vec3 moved_est = core::RotationZ(-from.yaw_est_rad) * (to.p_est - from.p_est);
  const double turned_true_rad = to.yaw_true_rad - from.yaw_true_rad;
  const double turned_est_rad = to.yaw_est_rad - from.yaw_est_rad;
  return {moved_est - moved_true, core::WrapToPi(turned_est_rad - turned_true_rad)};
}

double HorizontalDistance(const PosePair& a, const PosePair& b) {
  return (b.p_true - a.p_true).head<2>().norm();
}

/// Root of the mean of squares of two groups together.
double PooledRms(double a, std::uint64_t count_a, double b, std::uint64_t count_b) {
  const auto n_a = static_cast<double>(count_a), n_b = static_cast<double>(count_b);
  return n_a + n_b > 0.0 ? std::sqrt((a * a * n_a + b * b * n_b) / (n_a + n_b)) : 0.0;
}

double PooledMean(double a, std::uint64_t count_a, double b, std::uint64_t count_b) {
  const auto n_a = static_cast<double>(count_a), n_b = static_cast<double>(count_b);
  return n_a + n_b > 0.0 ? (a * n_a + b * n_b) / (n_a + n_b) : 0.0;
}

template <class Get>
double MedianMagnitude(const std::vector<DriftSegment>& segments, Get get) {
  std::vector<double> sizes;
  for (const DriftSegment& s : segments) sizes.push_back(std::abs(get(s)));
  std::sort(sizes.begin(), sizes.end());
  const std::size_t middle = sizes.size() / 2;
  return sizes.size() % 2 == 1 ? sizes[middle] : 0.5 * (sizes[middle - 1] + sizes[middle]);
}

}  // namespace

std::optional<double> HeightDrift(const logs::Row& row) noexcept {
  if (!row.truth || !row.estimate) return std::nullopt;
  return row.estimate->p_WB_m[2] - row.truth->p_WB_m[2];
}

std::optional<Vec3> FromEstimatorFrame(const logs::Row& row, const Vec3& p_W_est) noexcept {
  if (!row.truth || !row.estimate) return std::nullopt;
  const double yaw_drift_rad = row.estimate->rpy_rad[2] - row.truth->rpy_rad[2];
  return logs::ToVec3(row.truth->p_WB_m) +
         core::RotationZ(-yaw_drift_rad) * (p_W_est - logs::ToVec3(row.estimate->p_WB_m));
}

std::optional<double> CalcNees(const logs::Row& row) {
  if (!row.truth || !row.estimate || !row.estimate->P_tilt_v) return std::nullopt;
  const Mat3 R_error = core::RotationFromRpy(logs::ToVec3(row.estimate->rpy_rad)) *
                       core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad)).transpose();
  Eigen::Matrix<double, 5, 1> error;
  error << core::LogSo3(R_error).head<2>(),
      logs::ToVec3(row.estimate->v_WB_mps) - R_error * logs::ToVec3(row.truth->v_WB_mps);
  Eigen::Matrix<double, 5, 5> P = Eigen::Matrix<double, 5, 5>::Zero();  // its lower triangle
  auto entry = row.estimate->P_tilt_v->begin();
  for (int i = 0; i < P.rows(); ++i) {
    for (int j = 0; j <= i; ++j) P(i, j) = *entry++;
  }
  return error.dot(P.ldlt().solve(error));
}

RelativePoseError& RelativePoseError::operator+=(const RelativePoseError& other) noexcept {
  horizontal_rms_m =
      PooledRms(horizontal_rms_m, stretches, other.horizontal_rms_m, other.stretches);
  vertical_rms_m = PooledRms(vertical_rms_m, stretches, other.vertical_rms_m, other.stretches);
  stretches += other.stretches;
  return *this;
}

EstimationMetrics& EstimationMetrics::operator+=(const EstimationMetrics& o) {
  present = present || o.present;
  segments.insert(segments.end(), o.segments.begin(), o.segments.end());
  stub_segments += o.stub_segments;
  rpe_1m += o.rpe_1m;
  rpe_10m += o.rpe_10m;
  velocity_rmse_mps = PooledRms(velocity_rmse_mps, rows, o.velocity_rmse_mps, o.rows);
  roll_rmse_rad = PooledRms(roll_rmse_rad, rows, o.roll_rmse_rad, o.rows);
  pitch_rmse_rad = PooledRms(pitch_rmse_rad, rows, o.pitch_rmse_rad, o.rows);
  rows += o.rows;
  nees_ratio = PooledMean(nees_ratio, nees_rows, o.nees_ratio, o.nees_rows);
  nees_rows += o.nees_rows;
  nis_ratio = PooledMean(nis_ratio, nis_dof, o.nis_ratio, o.nis_dof);
  nis_rows += o.nis_rows;
  nis_dof += o.nis_dof;
  force_stance_rmse_N =
      PooledRms(force_stance_rmse_N, force_stance_rows, o.force_stance_rmse_N, o.force_stance_rows);
  force_stance_rows += o.force_stance_rows;
  force_swing_rmse_N =
      PooledRms(force_swing_rmse_N, force_swing_rows, o.force_swing_rmse_N, o.force_swing_rows);
  force_swing_rows += o.force_swing_rows;
  contact += o.contact;
  return *this;
}

DriftSummary SummariseDrift(const EstimationMetrics& m, double min_segment_m) {
  std::vector<DriftSegment> used;
  for (const DriftSegment& s : m.segments) {
    if (s.distance_m >= min_segment_m) used.push_back(s);
  }
  DriftSummary d;
  d.short_segments = static_cast<int>(m.segments.size() - used.size()) + m.stub_segments;
  d.used_short = used.empty() && !m.segments.empty();
  if (d.used_short) used = m.segments;
  d.segments = static_cast<int>(used.size());
  if (used.empty()) return d;
  for (const DriftSegment& s : used) d.distance_m += s.distance_m;
  d.horizontal_pct = MedianMagnitude(used, [](const auto& s) { return s.horizontal_pct; });
  d.vertical_pct = MedianMagnitude(used, [](const auto& s) { return s.vertical_pct; });
  d.yaw_deg_per_m = MedianMagnitude(used, [](const auto& s) { return s.yaw_deg_per_m; });
  return d;
}

RelativePoseError DriftTracker::ErrorOf(const Stretches& s) noexcept {
  if (s.count == 0) return {};
  const auto n = static_cast<double>(s.count);
  return {s.count, std::sqrt(s.sum_horizontal_m2 / n), std::sqrt(s.sum_vertical_m2 / n)};
}

void DriftTracker::Reset() noexcept {
  active_ = false;
  path_m_ = 0.0;
  num_marks_ = 0;
  for (Stretches& s : stretches_) s.next = 0;
}

void DriftTracker::Add(const PosePair& now) noexcept {
  last_ = now;
  if (!active_) {
    active_ = true;
    start_ = chord_ = now;
    PushMark(now);
  }
  const double chord_m = HorizontalDistance(chord_, now);
  if (chord_m < kChord_m - kRounding_m) return;
  path_m_ += chord_m;
  chord_ = now;
  if (path_m_ - MarkAt(num_marks_ - 1).path_m >= kMark_m - kRounding_m) PushMark(now);
}

/// Stretches end at the mark before the newest, so that a fall can still take the newest back.
void DriftTracker::PushMark(const PosePair& now) noexcept {
  MarkAt(num_marks_++) = {now, path_m_};
  if (num_marks_ > 1) EndStretchesAt(MarkAt(num_marks_ - 2));
}

void DriftTracker::EndStretchesAt(const Mark& end) noexcept {
  for (Stretches& s : stretches_) {
    while (end.path_m - MarkAt(s.next).path_m >= s.length_m - kRounding_m) {
      const StretchError error = CalcStretchError(MarkAt(s.next).pose, end.pose);
      s.sum_horizontal_m2 += error.p_m.head<2>().squaredNorm();
      s.sum_vertical_m2 += error.p_m.z() * error.p_m.z();
      ++s.count;
      ++s.next;
    }
  }
}

void DriftTracker::End(bool fell) {
  if (!active_) return;
  Mark end = {last_, path_m_ + HorizontalDistance(chord_, last_)};
  if (fell) {
    end = num_marks_ > 1 ? MarkAt(num_marks_ - 2) : Mark{start_, 0.0};
  } else {
    EndStretchesAt(MarkAt(num_marks_ - 1));
  }
  if (end.path_m >= kLeastSegment_m) {
    const StretchError error = CalcStretchError(start_, end.pose);
    segments_.push_back({end.path_m, 100.0 * error.p_m.head<2>().norm() / end.path_m,
                         100.0 * error.p_m.z() / end.path_m,
                         core::kDegreesPerRad * error.yaw_rad / end.path_m});
  } else {
    ++stub_segments_;
  }
  Reset();
}

void EstimationAccumulator::MeanSquare::Add(double error) noexcept {
  sum += error * error;
  ++count;
}

double EstimationAccumulator::MeanSquare::Root() const noexcept {
  return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

void EstimationAccumulator::AddRow(const logs::Row& row) {
  if (!row.episode) return;
  const bool walking = row.episode->operating && !row.episode->fallen;
  if (walking_ && (!walking || row.episode->segment != segment_)) {
    drift_.End(row.episode->fallen);
    contact_.Break();
  }
  walking_ = walking;
  segment_ = row.episode->segment;
  if (!walking) return;
  contact_.AddRow(row);
  if (row.true_contacts && row.true_contacts->f_F_W_N && row.contacts && row.contacts->f_F_W_N)
    AddForces(*row.true_contacts, *row.contacts->f_F_W_N);
  AddConsistency(row);
  if (row.truth && row.estimate) AddErrors(*row.truth, *row.estimate);
}

void EstimationAccumulator::AddErrors(const logs::TruthRow& truth,
                                      const logs::EstimateRow& estimate) noexcept {
  drift_.Add({logs::ToVec3(truth.p_WB_m), logs::ToVec3(estimate.p_WB_m), truth.rpy_rad[2],
              estimate.rpy_rad[2]});
  const Vec3 v_true_B =
      core::RotationFromRpy(logs::ToVec3(truth.rpy_rad)).transpose() * logs::ToVec3(truth.v_WB_mps);
  const Vec3 v_est_B = core::RotationFromRpy(logs::ToVec3(estimate.rpy_rad)).transpose() *
                       logs::ToVec3(estimate.v_WB_mps);
  velocity_.Add((v_est_B - v_true_B).norm());
  roll_.Add(core::WrapToPi(estimate.rpy_rad[0] - truth.rpy_rad[0]));
  pitch_.Add(core::WrapToPi(estimate.rpy_rad[1] - truth.rpy_rad[1]));
  constexpr double kSame_m = 1e-6;
  if ((logs::ToVec3(estimate.p_WB_m) - logs::ToVec3(truth.p_WB_m)).norm() > kSame_m)
    present_ = true;
}

void EstimationAccumulator::AddConsistency(const logs::Row& row) noexcept {
  if (row.estimate && (row.estimate->P_tilt_v || row.estimate->innovation)) present_ = true;
  if (const std::optional<double> nees = CalcNees(row)) {
    sum_nees_ += *nees;
    ++nees_rows_;
  }
  if (row.estimate && row.estimate->innovation) {
    sum_nis_ += row.estimate->innovation->nis;
    nis_dof_ += row.estimate->innovation->dof;
    ++nis_rows_;
  }
}

void EstimationAccumulator::AddForces(const logs::TrueContactsRow& truth,
                                      const logs::Array12& f_F_W_N) noexcept {
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const std::size_t z = 3 * leg + 2;
    (truth.contact[leg] ? force_stance_ : force_swing_).Add(f_F_W_N[z] - (*truth.f_F_W_N)[z]);
  }
}

EstimationMetrics EstimationAccumulator::Finish() {
  drift_.End(false);
  EstimationMetrics m;
  m.present = present_;
  m.segments = drift_.segments();
  m.stub_segments = drift_.stub_segments();
  m.rpe_1m = drift_.rpe_1m();
  m.rpe_10m = drift_.rpe_10m();
  m.rows = velocity_.count;
  m.velocity_rmse_mps = velocity_.Root();
  m.roll_rmse_rad = roll_.Root();
  m.pitch_rmse_rad = pitch_.Root();
  m.nees_rows = nees_rows_;
  if (nees_rows_ > 0) m.nees_ratio = sum_nees_ / (kNeesDof * static_cast<double>(nees_rows_));
  m.nis_rows = nis_rows_;
  m.nis_dof = nis_dof_;
  if (nis_dof_ > 0) m.nis_ratio = sum_nis_ / static_cast<double>(nis_dof_);
  m.force_stance_rmse_N = force_stance_.Root();
  m.force_swing_rmse_N = force_swing_.Root();
  m.force_stance_rows = force_stance_.count;
  m.force_swing_rows = force_swing_.count;
  m.contact = contact_.metrics();
  return m;
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DriftSegment, distance_m, horizontal_pct, vertical_pct,
                                   yaw_deg_per_m)
namespace {

/// Null where nothing was counted.
nlohmann::json If(std::uint64_t count, double value) {
  return count > 0 ? nlohmann::json(value) : nlohmann::json(nullptr);
}

/// Leaves `value` as it is where there is null.
void Read(const nlohmann::json& j, const char* key, double& value) {
  if (const nlohmann::json& found = j.at(key); !found.is_null()) found.get_to(value);
}

}  // namespace

void to_json(nlohmann::json& j, const RelativePoseError& e) {
  j = {{"stretches", e.stretches},
       {"horizontal_rms_m", If(e.stretches, e.horizontal_rms_m)},
       {"vertical_rms_m", If(e.stretches, e.vertical_rms_m)}};
}

void from_json(const nlohmann::json& j, RelativePoseError& e) {
  j.at("stretches").get_to(e.stretches);
  Read(j, "horizontal_rms_m", e.horizontal_rms_m);
  Read(j, "vertical_rms_m", e.vertical_rms_m);
}

void to_json(nlohmann::json& j, const EstimationMetrics& m) {
  j = {{"present", m.present},
       {"segments", m.segments},
       {"stub_segments", m.stub_segments},
       {"rpe_1m", m.rpe_1m},
       {"rpe_10m", m.rpe_10m},
       {"rows", m.rows},
       {"velocity_rmse_mps", If(m.rows, m.velocity_rmse_mps)},
       {"roll_rmse_rad", If(m.rows, m.roll_rmse_rad)},
       {"pitch_rmse_rad", If(m.rows, m.pitch_rmse_rad)},
       {"nees_ratio", If(m.nees_rows, m.nees_ratio)},
       {"nees_rows", m.nees_rows},
       {"nis_ratio", If(m.nis_dof, m.nis_ratio)},
       {"nis_rows", m.nis_rows},
       {"nis_dof", m.nis_dof},
       {"force_stance_rmse_N", If(m.force_stance_rows, m.force_stance_rmse_N)},
       {"force_swing_rmse_N", If(m.force_swing_rows, m.force_swing_rmse_N)},
       {"force_stance_rows", m.force_stance_rows},
       {"force_swing_rows", m.force_swing_rows},
       {"contact", m.contact}};
}

void from_json(const nlohmann::json& j, EstimationMetrics& m) {
  j.at("present").get_to(m.present);
  j.at("segments").get_to(m.segments);
  j.at("stub_segments").get_to(m.stub_segments);
  j.at("rpe_1m").get_to(m.rpe_1m);
  j.at("rpe_10m").get_to(m.rpe_10m);
  j.at("rows").get_to(m.rows);
  Read(j, "velocity_rmse_mps", m.velocity_rmse_mps);
  Read(j, "roll_rmse_rad", m.roll_rmse_rad);
  Read(j, "pitch_rmse_rad", m.pitch_rmse_rad);
  Read(j, "nees_ratio", m.nees_ratio);
  j.at("nees_rows").get_to(m.nees_rows);
  Read(j, "nis_ratio", m.nis_ratio);
  j.at("nis_rows").get_to(m.nis_rows);
  j.at("nis_dof").get_to(m.nis_dof);
  Read(j, "force_stance_rmse_N", m.force_stance_rmse_N);
  Read(j, "force_swing_rmse_N", m.force_swing_rmse_N);
  j.at("force_stance_rows").get_to(m.force_stance_rows);
  j.at("force_swing_rows").get_to(m.force_swing_rows);
  j.at("contact").get_to(m.contact);
}

}  // namespace scoria::analysis
