// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/dense_regulator.h"
#include "controller/qp/solvers/ocp_solver.h"
#include "controller/qp/solvers/wrench_regulator.h"
#include "core/config/field.h"

namespace scoria::controller {

struct RiccatiIpmParams {
  double start_complementarity = 1e-2;
  double tolerance = 1e-6;
  int max_iterations = 40;
  bool warm_start = true;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("start_complementarity", start_complementarity,
            {.min = 1e-8, .max = 1e3, .doc = "slack times multiplier of a cold start"});
    a.Field("tolerance", tolerance,
            {.min = 1e-12, .max = 1.0, .doc = "duality gap to stop at, relative to the cost"});
    a.Field("max_iterations", max_iterations, {.min = 1, .max = 200});
    a.Field("warm_start", warm_start, {.doc = "start from the last tick's solution"});
  }
  bool operator==(const RiccatiIpmParams&) const = default;
};

/// Primal-dual interior point method for OcpQp with Mehrotra's predictor-corrector; each Newton
/// system is a linear-quadratic regulator. Every iterate satisfies the dynamics and the force
/// limits strictly, so an early stop still yields a usable plan. Source: [Rao1998]; structure as
/// measured in docs/REFERENCES.md, QP baseline. Owns all its memory: no allocation.
class RiccatiIpm final : public OcpSolver {
 public:
  explicit RiccatiIpm(const RiccatiIpmParams& params) : params_(params) {}

  /// Forces that are not usable are NaN.
  [[nodiscard]] const OcpSolution& Solve(const OcpQp& qp) noexcept override;
  void Reset() noexcept override { last_.valid = false; }

  /// Of the last Solve.
  [[nodiscard]] const OcpSolution& solution() const noexcept { return solution_; }

 private:
  static constexpr int kRows = 6;  // inequalities per stance foot
  using RowTable = FootTable<kRows>;

  /// The last solution by stage and leg, for the next start.
  struct Memory {
    bool valid = false;
    int horizon = 0;
    std::array<LegArray<bool>, kMaxHorizon> known;
    Eigen::Array<double, FootIndex::kMaxFeet, 3> u;  // row: 4 stage + leg
    Eigen::Array<double, FootIndex::kMaxFeet, kRows> lambda;
  };

  [[nodiscard]] Regulator& regulator(const OcpQp& qp) noexcept {
    if (qp.forward_euler) return wrench_;
    return dense_;
  }
  void Load(const OcpQp& qp) noexcept;
  void Start(const OcpQp& qp) noexcept;
  void CalcSlacks(const FootTable<3>& u, RowTable& slack) const noexcept;
  [[nodiscard]] double Cost(const OcpQp& qp) const noexcept;
  void CalcWeights() noexcept;
  void CalcGradients(double target, bool corrector) noexcept;
  void CalcDirections(double target, bool corrector) noexcept;
  struct StepLengths {
    double primal = 1.0, dual = 1.0;
  };
  [[nodiscard]] StepLengths MaxSteps() const noexcept;
  [[nodiscard]] StepLengths CalcNewtonStep(const OcpQp& qp, double gap) noexcept;
  void TakeStep(const OcpQp& qp, StepLengths step) noexcept;
  void Extract(const OcpQp& qp) noexcept;

  RiccatiIpmParams params_;
  double friction_ = 0.0, f_min_ = 0.0, f_max_ = 0.0, cost_offset_ = 0.0;
  FootIndex feet_;
  FootTable<3> R_, r_;
  FootTrajectory now_, newton_;
  RowTable slack_, lambda_, weight_, inverse_slack_, d_slack_, d_lambda_;
  FootHessian hessian_;
  FootTable<3> gradient_;
  WrenchRegulator wrench_;
  DenseRegulator dense_;
  Memory last_;
  OcpSolution solution_;
};

}  // namespace scoria::controller
