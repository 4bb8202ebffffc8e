// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/legs_check.h"

namespace scoria::logs {

void LegsCheck::AddTick(const Tick& tick) {
  joints_.AddTick(tick);
  order_.AddTick(tick);
}

std::vector<Finding> LegsCheck::Conclude(const std::vector<Finding>& earlier) const {
  std::vector<Finding> joints = joints_.Conclude(earlier), order = order_.Conclude(earlier);
  const bool joints_are_wrong =
      HasError(joints, {FindingKind::kJointSign, FindingKind::kTorqueSign,
                        FindingKind::kJointOffset, FindingKind::kJointOrder});
  if (HasError(order, {FindingKind::kLegOrder}) &&
      (!joints_are_wrong || order.front().size > joints_.gain()))
    return order;
  if (joints_are_wrong) return joints;
  joints.insert(joints.end(), order.begin(), order.end());
  return joints;
}

}  // namespace scoria::logs
