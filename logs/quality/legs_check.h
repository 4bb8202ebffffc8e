// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "logs/quality/joint_check.h"
#include "logs/quality/leg_order_check.h"

namespace scoria::logs {

/// Legs in each other's columns, or joints within a leg: what explains more of a log is told, since
/// legs of the other side look like hips of the other sign.
class LegsCheck : public QualityCheck {
 public:
  explicit LegsCheck(const LogSubject& subject) : joints_(subject), order_(subject) {}
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  JointCheck joints_;
  LegOrderCheck order_;
};

}  // namespace scoria::logs
