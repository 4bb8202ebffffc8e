// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace scoria::core {

/// Time as a step index; seconds are derived. A rate is "every so many steps".
class StepClock {
 public:
  explicit StepClock(double step_s, std::int64_t first_step = 0) noexcept
      : step_s_(step_s), step_(first_step) {}
  void Advance() noexcept { ++step_; }
  [[nodiscard]] std::int64_t step() const noexcept { return step_; }
  [[nodiscard]] double step_s() const noexcept { return step_s_; }
  [[nodiscard]] double time_s() const noexcept { return static_cast<double>(step_) * step_s_; }
  [[nodiscard]] bool Due(int every_steps) const noexcept { return step_ % every_steps == 0; }

 private:
  double step_s_;
  std::int64_t step_;
};

}  // namespace scoria::core
