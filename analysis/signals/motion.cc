// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/motion.h"

namespace scoria::analysis {
namespace {

Vec3 ToVec3(const logs::Array3& v) { return {v[0], v[1], v[2]}; }

template <class Group>
TrunkMotion MotionOf(const Group& group, MotionSource source) {
  return {source, ToVec3(group.p_WB_m), ToVec3(group.v_WB_mps), ToVec3(group.rpy_rad)};
}

}  // namespace

std::optional<TrunkMotion> FindMotion(const logs::Row& row, MotionSource source) {
  if (source == MotionSource::kEstimate)
    return row.estimate ? std::optional(MotionOf(*row.estimate, source)) : std::nullopt;
  if (!row.truth) return std::nullopt;
  TrunkMotion motion = MotionOf(*row.truth, source);
  motion.ground_z_m = row.truth->ground_z_m;
  return motion;
}

std::optional<TrunkMotion> FindMotion(const logs::Row& row) {
  const auto truth = FindMotion(row, MotionSource::kTruth);
  return truth ? truth : FindMotion(row, MotionSource::kEstimate);
}

}  // namespace scoria::analysis
