// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "core/robot/description.h"
#include "logs/quality/finding.h"
#include "logs/quality/tick.h"
#include "logs/row.h"

namespace scoria::logs {

/// What is known of the robot of a log, and of where it walked.
struct LogSubject {
  const core::RobotDescription* robot = nullptr;  // borrowed; null: not known
  double gravity_mps2 = 9.81;
};

/// A family of checks: sees every row and every tick of a log once, in order, and keeps what does
/// not grow with it.
class QualityCheck {
 public:
  virtual ~QualityCheck() = default;
  virtual void AddRow(const Row&) {}
  virtual void AddTick(const Tick&) {}
  /// After the last row. @param earlier  what the families before this one found: what follows from
  /// one of their errors is not said again.
  [[nodiscard]] virtual std::vector<Finding> Conclude(
      const std::vector<Finding>& earlier) const = 0;
};
using QualityChecks = std::vector<std::unique_ptr<QualityCheck>>;

}  // namespace scoria::logs
