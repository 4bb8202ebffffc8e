// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/robot/whole_body.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {

/// Torques against the robot's weight: the mean of the forces of the feet that they tell is the
/// weight.
class LoadCheck : public QualityCheck {
 public:
  /// Payloads, friction and motors' constants make kWarning on real robots. From kScale on it is
  /// rather a scale than a mass, and beyond kError no payload is so heavy.
  static constexpr double kWarning = 0.15, kScaleAbove = 1.3, kScaleBelow = 0.75, kErrorAbove = 1.6,
                          kErrorBelow = 0.6;

  explicit LoadCheck(const LogSubject& subject);
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  [[nodiscard]] std::optional<Finding> MassFinding() const;

  LogSubject subject_;
  std::optional<core::WholeBodyModel> model_;
  BlockMean force_;  // sum of f_z, N
};

}  // namespace scoria::logs
