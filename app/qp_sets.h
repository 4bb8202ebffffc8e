// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/qp/dense_qp.h"
#include "controller/qp/ocp_qp.h"

namespace scoria::app {

/// A file of reference problems with their solutions (format: the README beside them).
class QpSet {
 public:
  /// Errors: std::runtime_error that names the file and what is wrong.
  explicit QpSet(const std::filesystem::path& file);

  [[nodiscard]] bool IsMpc() const { return magic_ == "SRBDMPC1"; }
  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] int horizon() const { return d0_; }

  struct Mpc {
    controller::OcpQp qp;
    std::array<Vec12, kMaxHorizon> u;  // reference solution
  };
  [[nodiscard]] Mpc ReadMpc(int index) const;

  struct Wbc {
    controller::DenseQp qp;
    Eigen::VectorXd z;  // reference solution
  };
  [[nodiscard]] Wbc ReadWbc(int index) const;

 private:
  std::string magic_;
  int count_ = 0, d0_ = 0, d1_ = 0, d2_ = 0, record_ = 0, meta_ = 0;
  std::vector<double> data_;
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

/// Solves every .bin set of a folder and times it, forward-Euler and other dynamics apart: per
/// problem the median of `repeats`, then median
/// and p99 over problems.
[[nodiscard]] std::vector<QpBenchmark> BenchmarkQpSets(const std::filesystem::path& folder,
                                                       int repeats);

}  // namespace scoria::app
