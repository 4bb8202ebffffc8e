// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "analysis/statistics/power.h"

namespace scoria::app {

/// --alpha and --power. `goal` must live as long as the command.
inline void AddTestGoal(CLI::App& command, analysis::TestGoal& goal) {
  command.add_option("--alpha", goal.alpha, "two-sided level of the tests whose power is told")
      ->check(CLI::Range(1e-6, 0.5))
      ->capture_default_str();
  command.add_option("--power", goal.power, "probability of seeing an effect that is there")
      ->check(CLI::Range(0.05, 0.999))
      ->capture_default_str();
}

}  // namespace scoria::app
