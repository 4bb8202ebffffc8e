// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/aligned_rows.h"

#include <algorithm>
#include <utility>

#include "core/math/so3.h"
#include "logs/vectors.h"

namespace scoria::analysis {
namespace {

logs::Array3 Mixed(const logs::Array3& a, const logs::Array3& b, double s) {
  return logs::ToArray((1.0 - s) * logs::ToVec3(a) + s * logs::ToVec3(b));
}

logs::TruthRow Mixed(const logs::TruthRow& a, const logs::TruthRow& b, double s) {
  const BodyPose pose =
      Interpolate({core::RotationFromRpy(logs::ToVec3(a.rpy_rad)), logs::ToVec3(a.p_WB_m)},
                  {core::RotationFromRpy(logs::ToVec3(b.rpy_rad)), logs::ToVec3(b.p_WB_m)}, s);
  logs::TruthRow out;
  out.p_WB_m = logs::ToArray(pose.p_WB);
  out.v_WB_mps = Mixed(a.v_WB_mps, b.v_WB_mps, s);
  out.w_WB_radps = Mixed(a.w_WB_radps, b.w_WB_radps, s);
  out.rpy_rad = logs::ToArray(core::RpyFromRotation(pose.R_WB));
  if (a.ground_z_m && b.ground_z_m) out.ground_z_m = (1.0 - s) * *a.ground_z_m + s * *b.ground_z_m;
  return out;
}

}  // namespace

AlignedRows::AlignedRows(const TruthAlignment& alignment, OnRow on_row)
    : alignment_(alignment), on_row_(std::move(on_row)) {}

void AlignedRows::Add(const logs::Row& row) {
  if (newest_s_ && row.time_s < *newest_s_) {  // the clock was set back
    Finish();
    truths_.clear();
  }
  newest_s_ = row.time_s;
  waiting_.push_back(row);
  if (row.truth) truths_.push_back({row.time_s, *row.truth});
  while (!waiting_.empty() && IsReady(waiting_.front())) PassFirst();
}

void AlignedRows::Finish() {
  while (!waiting_.empty()) PassFirst();
}

/// Whether a truth beside the one that the row wants is there, or can no more come.
bool AlignedRows::IsReady(const logs::Row& row) const {
  const double wanted_s = row.time_s + alignment_.offset.delay_s;
  return *newest_s_ > wanted_s + kLongestPause_s ||
         (!truths_.empty() && truths_.back().time_s >= wanted_s);
}

void AlignedRows::PassFirst() {
  logs::Row row = std::move(waiting_.front());
  waiting_.pop_front();
  const double wanted_s = row.time_s + alignment_.offset.delay_s;
  row.truth = TruthAt(wanted_s);
  if (row.truth) row.truth = OfTrunk(*row.truth);
  while (truths_.size() > 1 && truths_[1].time_s <= wanted_s) truths_.pop_front();
  on_row_(row);
}

std::optional<logs::TruthRow> AlignedRows::TruthAt(double time_s) const {
  const auto after =
      std::lower_bound(truths_.begin(), truths_.end(), time_s,
                       [](const TimedTruth& t, double at_s) { return t.time_s < at_s; });
  if (after == truths_.end()) return std::nullopt;
  if (after->time_s == time_s) return after->truth;
  if (after == truths_.begin()) return std::nullopt;
  const TimedTruth& before = *std::prev(after);
  const double step_s = after->time_s - before.time_s;
  if (step_s > kLongestPause_s) return std::nullopt;
  return Mixed(before.truth, after->truth, (time_s - before.time_s) / step_s);
}

logs::TruthRow AlignedRows::OfTrunk(const logs::TruthRow& markers) const {
  const Mat3 R_WB =
      core::RotationFromRpy(logs::ToVec3(markers.rpy_rad)) * alignment_.offset.R_BM.transpose();
  const Vec3 p_BM_W = alignment_.lever_arm ? Vec3(R_WB * alignment_.lever_arm->p_BM) : Vec3::Zero();
  const Vec3 w = logs::ToVec3(markers.w_WB_radps);
  logs::TruthRow out = markers;
  out.p_WB_m = logs::ToArray(logs::ToVec3(markers.p_WB_m) - p_BM_W);
  out.v_WB_mps = logs::ToArray(logs::ToVec3(markers.v_WB_mps) - w.cross(p_BM_W));
  out.rpy_rad = logs::ToArray(core::RpyFromRotation(R_WB));
  return out;
}

}  // namespace scoria::analysis
