// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "logs/row.h"

namespace scoria::analysis {

/// After the command changed, a placement or a released fallback nothing is steady for so long.
inline constexpr double kSettle_s = 3.0;

/// How far two speeds of about this size may differ and be the same: somebody steers along a route.
[[nodiscard]] double SpeedMargin(double speed_mps) noexcept;

/// Horizontal.
[[nodiscard]] double SpeedOf(const logs::CommandRow& command) noexcept;

/// Whether a command asks to stand still.
[[nodiscard]] bool IsStop(const logs::CommandRow& command) noexcept;

/// Since when the robot has had the present command: against the one with which the steady stretch
/// began, so that slow drifts count as changes, too.
class SteadyCommand {
 public:
  /// @returns true if a command begins with this sample.
  bool Update(double time_s, const logs::CommandRow& command) noexcept;
  /// The robot was placed: the next sample begins a command.
  void Restart() noexcept { command_.reset(); }
  [[nodiscard]] bool IsSettled(double time_s) const noexcept {
    return command_ && time_s - since_s_ >= kSettle_s;
  }

 private:
  std::optional<logs::CommandRow> command_;  // with which the stretch began
  double since_s_ = 0.0;
};

/// A window of steady walking at about the commanded speed.
struct SteadyWindow {
  double v_mps = 0.0, command_mps = 0.0;  // means
};

/// Cuts steady walking into windows of five seconds.
class SteadyWindows {
 public:
  struct Sample {
    double time_s = 0.0, dt_s = 0.0;  // now; since the sample before
    double command_mps = 0.0;
    bool on_fallback = false;
  };
  struct Step {
    bool begins = false;                // a window does, with this sample
    std::optional<SteadyWindow> ended;  // one that was steady did
  };

  /// Everything begins anew: the command changed, or the robot was placed.
  void Restart(double time_s) noexcept;
  /// Way walked, to be told before the sample with which it ends.
  void AddWay(double way_m) noexcept { way_m_ += way_m; }
  [[nodiscard]] Step Add(const Sample& sample) noexcept;

 private:
  void Begin(double time_s) noexcept;

  double start_s_ = 0.0, settled_s_ = 0.0, way_m_ = 0.0, commanded_m_ = 0.0;
};

}  // namespace scoria::analysis
