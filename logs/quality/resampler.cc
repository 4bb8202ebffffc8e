// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/resampler.h"

#include <utility>

namespace scoria::logs {

Resampler::Resampler(std::function<void(const Tick&)> on_tick) : on_tick_(std::move(on_tick)) {}

void Resampler::Add(const Tick& sample, bool interrupts) {
  const double step_s = last_ ? sample.time_s - last_->time_s : 0.0;
  if (!last_ || interrupts || step_s < 0.0 || step_s > kLongestPause_s) {
    is_first_ = true;
    next_s_ = sample.time_s;
  }
  if (step_s > 0.0) {
    for (; next_s_ <= sample.time_s; next_s_ += kTick_s) {
      if (next_s_ < last_->time_s) continue;  // the first tick of a stretch is at its first sample
      Tick tick = Interpolate(*last_, sample, (next_s_ - last_->time_s) / step_s);
      tick.time_s = next_s_;
      tick.is_first = std::exchange(is_first_, false);
      on_tick_(tick);
    }
  }
  last_ = sample;
}

}  // namespace scoria::logs
