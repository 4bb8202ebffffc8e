// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/qp/solvers/qp_solvers.h"

namespace scoria::controller {

/// How a solver did on a file, or on the part of it that is of one kind. Times are medians and 99th
/// percentiles over problems.
struct QpBenchmark {
  std::string file, solver;
  std::string kind;  // dynamics of the MPC's problems, else the solver
  int problems = 0, solved = 0;
  double worst_error = 0.0;  // MPC: relative objective gap; WBC: |z - z*| relative to max(1, |z*|)
  double worst_violation = 0.0;  // of the force limits [N], MPC
  double median_us = 0.0, p99_us = 0.0, mean_iterations = 0.0;
  // MPC: every second record started from the solution of the one before it, 10 ms earlier.
  int warm_problems = 0, warm_solved = 0;
  double warm_median_us = 0.0, warm_p99_us = 0.0, warm_mean_iterations = 0.0;
};

/// Solves every .bin file of a folder with every solver that takes its problems, forward-Euler and
/// other dynamics apart. A problem's time is the median of `repeats` ≥ 1 solves.
/// Errors: std::runtime_error that names the file and what is wrong.
[[nodiscard]] std::vector<QpBenchmark> BenchmarkQpFiles(const std::filesystem::path& folder,
                                                        const QpSolvers& solvers, int repeats);

}  // namespace scoria::controller
