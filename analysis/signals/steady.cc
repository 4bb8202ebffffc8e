// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/steady.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {
namespace {

bool IsSameCommand(const logs::CommandRow& a, const logs::CommandRow& b) noexcept {
  constexpr double kSameYaw_radps = 0.6;
  const double margin_mps = SpeedMargin(std::max(SpeedOf(a), SpeedOf(b)));
  return std::abs(a.v_x_mps - b.v_x_mps) < margin_mps &&
         std::abs(a.v_y_mps - b.v_y_mps) < margin_mps &&
         std::abs(a.w_z_radps - b.w_z_radps) < kSameYaw_radps && IsStop(a) == IsStop(b);
}

}  // namespace

double SpeedMargin(double speed_mps) noexcept {
  constexpr double kSame_mps = 0.05, kSameShare = 0.15;
  return kSame_mps + kSameShare * speed_mps;
}

double SpeedOf(const logs::CommandRow& command) noexcept {
  return std::hypot(command.v_x_mps, command.v_y_mps);
}

bool IsStop(const logs::CommandRow& command) noexcept { return command == logs::CommandRow{}; }

bool SteadyCommand::Update(double time_s, const logs::CommandRow& command) noexcept {
  if (command_ && IsSameCommand(command, *command_)) return false;
  command_ = command;
  since_s_ = time_s;
  return true;
}

void SteadyWindows::Restart(double time_s) noexcept {
  settled_s_ = time_s + kSettle_s;
  Begin(time_s);
}

void SteadyWindows::Begin(double time_s) noexcept {
  start_s_ = time_s;
  way_m_ = commanded_m_ = 0.0;
}

SteadyWindows::Step SteadyWindows::Add(const Sample& sample) noexcept {
  constexpr double kWindow_s = 5.0, kRounding_s = 1e-9;
  if (sample.on_fallback) settled_s_ = sample.time_s + kSettle_s;
  if (sample.time_s < settled_s_ || sample.command_mps == 0.0) {
    Begin(sample.time_s);
    return {.begins = true, .ended = std::nullopt};
  }
  commanded_m_ += sample.command_mps * sample.dt_s;
  const double elapsed_s = sample.time_s - start_s_;
  if (elapsed_s < kWindow_s - kRounding_s) return {};
  const SteadyWindow window = {way_m_ / elapsed_s, commanded_m_ / elapsed_s};
  Begin(sample.time_s);
  const bool steady = std::abs(window.v_mps - window.command_mps) < SpeedMargin(window.command_mps);
  return {.begins = true, .ended = steady ? std::optional(window) : std::nullopt};
}

}  // namespace scoria::analysis
