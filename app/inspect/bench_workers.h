// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "app/scenario/scenario.h"

namespace scoria::app {

/// Wall-clock time of the same episodes in one worker process at a time and in two.
struct WorkersPair {
  double one_s = 0.0, two_s = 0.0;
  [[nodiscard]] double gain() const noexcept { return one_s / two_s; }
};

/// Walks episodes of a scenario, each in a process of its own and on its own seed, with one worker
/// and then with two, several times over. The second half of a pair runs from the same warm cache.
/// @param program  the scoria executable. @param episodes  even.
/// Errors: std::runtime_error if an episode leaves no result; core::FileError.
[[nodiscard]] std::vector<WorkersPair> BenchmarkWorkers(const Scenario& scenario,
                                                        const std::string& program, int episodes,
                                                        int pairs);

}  // namespace scoria::app
