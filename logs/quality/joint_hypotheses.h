// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "logs/quality/finding.h"

namespace scoria::logs {

/// What may have been done to a leg's joints on their way into the log, and how to undo it.
struct JointHypothesis {
  FindingKind kind = FindingKind::kNotJudged;  // that: nothing was done
  std::optional<Joint> joint = std::nullopt;
  Vec3 sign = Vec3::Ones();             // of q, qd and tau
  Vec3 torque_sign = Vec3::Ones();      // of tau alone
  Vec3 offset_rad = Vec3::Zero();       // that q has too much
  std::array<int, 3> from = {0, 1, 2};  // the column that holds each joint

  [[nodiscard]] Vec3 UndoAngle(const Vec3& q) const;
  [[nodiscard]] Vec3 UndoRate(const Vec3& qd) const;
  [[nodiscard]] Vec3 UndoTorque(const Vec3& tau) const;
  [[nodiscard]] std::string Describe() const;
  [[nodiscard]] std::string Repair() const;
};

/// All of them; the first is that nothing was done.
[[nodiscard]] const std::vector<JointHypothesis>& JointHypotheses();

}  // namespace scoria::logs
