// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/estimate_consistency.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace scoria::analysis {
namespace {

/// Shorter ones the trunk's sway makes.
constexpr double kChord_m = 0.1;

}  // namespace

void ConsistencyAccumulator::Plane::Add(const Vec3& p) noexcept {
  if (!origin_) origin_ = p;
  const Vec3 d = p - *origin_;
  const Vec3 row(1.0, d.x(), d.y());
  A_ += row * row.transpose();
  b_ += row * d.z();
  zz_ += d.z() * d.z();
  ++count_;
}

double ConsistencyAccumulator::Plane::SquaredResidual() const {
  if (count_ < 4) return 0.0;
  const Vec3 x = A_.ldlt().solve(b_);
  return std::max(0.0, zz_ - b_.dot(x));
}

void ConsistencyAccumulator::Add(const FeetInstant& now, std::uint32_t segment) {
  if (segment_ != segment) {
    EndSegment();
    segment_ = segment;
    start_ = chord_ = now.p_WB;
  }
  last_ = now.p_WB;
  if (const double chord_m = (now.p_WB - chord_).norm(); chord_m >= kChord_m) {
    segment_path_m_ += chord_m;
    chord_ = now.p_WB;
  }
  for (const Leg leg : kLegs) {
    if (!now.contact[leg]) {
      EndStance(leg);
      continue;
    }
    sum_speed_m2ps2_ += now.v_WContact[leg].squaredNorm();
    ++out_.stance_samples;
    stance_[leg].sum += now.p_WF[leg];
    ++stance_[leg].count;
  }
}

void ConsistencyAccumulator::EndStance(Leg leg) {
  Stance& stance = stance_[leg];
  if (stance.count > 0) plane_.Add(stance.sum / static_cast<double>(stance.count));
  stance = {};
}

void ConsistencyAccumulator::EndSegment() {
  if (!segment_) return;
  for (const Leg leg : kLegs) EndStance(leg);
  sum_plane_m2_ += plane_.SquaredResidual();
  if (plane_.count() >= 4) out_.footholds += plane_.count();
  plane_ = {};
  out_.path_m += segment_path_m_;
  if (segment_path_m_ > out_.closure_path_m) {
    out_.closure_path_m = segment_path_m_;
    out_.closure_m = (last_ - start_).norm();
  }
  segment_path_m_ = 0.0;
}

EstimateConsistency ConsistencyAccumulator::Finish() {
  EndSegment();
  segment_.reset();
  const auto rms = [](double sum, std::uint64_t count) {
    return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
  };
  out_.stance_speed_rms_mps = rms(sum_speed_m2ps2_, out_.stance_samples);
  out_.plane_rms_m = rms(sum_plane_m2_, out_.footholds);
  return out_;
}

}  // namespace scoria::analysis
