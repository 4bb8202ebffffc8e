// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/motion.h"

#include "logs/vectors.h"

namespace scoria::analysis {
namespace {

template <class Group>
TrunkMotion MotionOf(const Group& group, MotionSource source) {
  return {source, logs::ToVec3(group.p_WB_m), logs::ToVec3(group.v_WB_mps),
          logs::ToVec3(group.rpy_rad)};
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
