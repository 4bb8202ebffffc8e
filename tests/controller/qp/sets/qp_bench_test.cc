// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_bench.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/qp_files.h"

namespace scoria::controller {
namespace {

/// Answers zero and calls it optimal.
class ZeroSolver final : public OcpSolver {
 public:
  const OcpSolution& Solve(const OcpQp&) noexcept override {
    for (Vec12& u : solution_.u) u.setZero();
    solution_.status = SolveStatus::kOptimal;
    ++solves;
    return solution_;
  }
  void Reset() noexcept override { ++resets; }
  int solves = 0, resets = 0;

 private:
  OcpSolution solution_;
};

/// Takes nothing.
class RefusingSolver final : public DenseSolver {
 public:
  DenseSolutionView Solve(const DenseQpView&) noexcept override {
    return {SolveStatus::kTooLarge, 0, {nullptr, 0}, {nullptr, 0}, {nullptr, 0}};
  }
};

TEST(QpBench, EverySolverMeetsEveryProblemOfItsKind) {
  const test::QpFolder folder(8);
  const std::vector<QpBenchmark> rows = BenchmarkQpFiles(folder.path(), MakeQpSolvers(), 1);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].kind, "forward Euler");
  EXPECT_EQ(rows[1].kind, "zero-order hold");
  EXPECT_EQ(rows[2].kind, "null space");
  EXPECT_EQ(rows[3].kind, "dense");
  for (const QpBenchmark& b : rows) {
    const bool mpc = b.file == "mpc.bin";
    EXPECT_EQ(b.problems, mpc ? 4 : 8) << b.kind;
    EXPECT_EQ(b.solved, b.problems) << b.kind;
    EXPECT_EQ(b.warm_problems, mpc ? 2 : 0) << b.kind;
    EXPECT_EQ(b.warm_solved, b.warm_problems) << b.kind;
    EXPECT_LT(b.worst_error, 1e-5) << b.kind;
    EXPECT_GT(b.median_us, 0.0) << b.kind;
  }
}

TEST(QpBench, WrongAndMissingAnswersShow) {
  const test::QpFolder folder(4);
  auto zero = std::make_unique<ZeroSolver>();
  const ZeroSolver& calls = *zero;
  QpSolvers solvers;
  solvers.ocp.push_back({"zero", std::move(zero)});
  solvers.dense.push_back({"refusing", std::make_unique<RefusingSolver>()});
  const std::vector<QpBenchmark> rows = BenchmarkQpFiles(folder.path(), solvers, 3);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].solver, "zero");
  EXPECT_GT(rows[0].worst_error, 1e-3);
  EXPECT_EQ(rows[0].worst_violation, 2.0) << "the least force of a stance foot, N";
  EXPECT_EQ(rows[2].kind, "refusing");
  EXPECT_EQ(rows[2].solved, 0);
  EXPECT_EQ(rows[2].worst_error, 1e30);
  // Four cold problems and two warm ones, three times each, those after a solve of their own.
  EXPECT_EQ(calls.solves, 3 * (4 + 2 * 2));
  EXPECT_EQ(calls.resets, 3 * (4 + 2));
}

// Every file of the reference data: objective gap of the MPC and distance of the WBC's solution at
// most 1e-6.
TEST(QpBench, ReferenceProblemsAreSolvedToTheirKnownAnswers) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const QpSolvers solvers = MakeQpSolvers();
  for (const QpBenchmark& b : BenchmarkQpFiles(std::filesystem::path(data) / "qp", solvers, 1)) {
    EXPECT_EQ(b.solved, b.problems) << b.file << " " << b.solver;
    EXPECT_EQ(b.warm_solved, b.warm_problems) << b.file << " " << b.solver;
    EXPECT_GT(b.problems, 0) << b.file << " " << b.solver;
    EXPECT_LE(b.worst_error, 1e-6) << b.file << " " << b.solver;
    EXPECT_LE(b.worst_violation, 1e-9) << b.file << " " << b.solver;
  }
}

}  // namespace
}  // namespace scoria::controller
