// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/robot_warnings.h"

#include <fmt/format.h>

#include "core/robot_files/inspect.h"

namespace scoria::app {

std::vector<std::string> WalkWarnings(const core::RobotDescription& robot,
                                      const controller::MpcParams& mpc, double gravity_mps2) {
  std::vector<std::string> out = core::FindModelWarnings(robot);
  const double load_N = 0.5 * robot.total_mass_kg() * gravity_mps2;  // of a foot in a trot
  if (load_N > mpc.f_max_N) {
    out.push_back(
        fmt::format("{:.1f} kg are {:.0f} N per foot on two feet, more than controller.mpc.f_max_N "
                    "{:g}; raise it",
                    robot.total_mass_kg(), load_N, mpc.f_max_N));
  }
  return out;
}

}  // namespace scoria::app
