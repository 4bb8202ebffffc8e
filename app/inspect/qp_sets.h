// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "controller/qp/dense_qp.h"
#include "controller/qp/ocp_qp.h"
#include "controller/wbc/tsid_problem.h"

namespace scoria::app {

/// A file of problems with their solutions, read record by record. Format: docs/qp_format.md.
class QpSet {
 public:
  /// Errors: std::runtime_error that names the file and what is wrong.
  explicit QpSet(const std::filesystem::path& file);

  [[nodiscard]] bool IsMpc() const { return magic_ == "SRBDMPC1"; }
  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] int horizon() const { return d0_; }

  struct Mpc {
    controller::OcpQp qp;
    // Reference solution: forces, states, costates, multipliers of the limits (6 per leg).
    std::array<Vec12, kMaxHorizon> u;
    std::array<Vec12, kMaxHorizon + 1> x, pi;
    std::array<Eigen::Matrix<double, 24, 1>, kMaxHorizon> lambda;
  };
  [[nodiscard]] Mpc ReadMpc(int index);

  struct Wbc {
    controller::DenseQp qp;           // as it stands
    controller::TsidProblem problem;  // the same in blocks
    Eigen::VectorXd z;                // reference solution, and its multipliers
    Eigen::VectorXd y, of_rows, of_bounds;
    LegArray<Vec3> f = ZeroPerLeg();  // the forces in it
  };
  [[nodiscard]] Wbc ReadWbc(int index);

 private:
  std::string magic_;
  int count_ = 0, d0_ = 0, d1_ = 0, d2_ = 0, record_ = 0, meta_ = 0;
  [[nodiscard]] const double* ReadRecord(int index);

  std::string name_;
  std::ifstream file_;
  std::vector<double> data_;  // of the record that was read last
};

/// How a set was solved.
struct QpBenchmark {
  std::string file, kind;
  int problems = 0, solved = 0;
  double worst_error = 0.0;  // MPC: relative objective gap; WBC: |z - z*| relative to max(1, |z*|)
  double worst_violation = 0.0;  // of the force limits [N], MPC
  double median_us = 0.0, p99_us = 0.0, mean_iterations = 0.0;
  // MPC: every second record started from the solution of the one before it, 10 ms earlier.
  int warm_problems = 0, warm_solved = 0;
  double warm_median_us = 0.0, warm_p99_us = 0.0, warm_mean_iterations = 0.0;
};

/// The .bin files of a folder, sorted. Errors: std::runtime_error if there are none.
[[nodiscard]] std::vector<std::filesystem::path> FindQpSets(const std::filesystem::path& folder);

/// Solves every .bin set of a folder and times it, forward-Euler and other dynamics apart: per
/// problem the median of `repeats`, then median
/// and p99 over problems.
[[nodiscard]] std::vector<QpBenchmark> BenchmarkQpSets(const std::filesystem::path& folder,
                                                       int repeats);

}  // namespace scoria::app
