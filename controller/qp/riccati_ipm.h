// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/ocp_qp.h"
#include "core/config/archive.h"

namespace scoria::controller {

struct RiccatiIpmParams {
  double start_complementarity = 1e-2;
  double tolerance = 1e-5;
  int max_iterations = 40;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("start_complementarity", start_complementarity, {.min = 1e-8, .max = 1e3});
    a.Field("tolerance", tolerance,
            {.min = 1e-12, .max = 1.0, .doc = "mean complementarity to stop at"});
    a.Field("max_iterations", max_iterations, {.min = 1, .max = 200});
  }
};

/// Primal-dual interior point method for OcpQp with Mehrotra's predictor-corrector; each Newton
/// system is a linear-quadratic regulator, solved by one Riccati recursion over the stance feet
/// only. Every iterate satisfies the dynamics and the force limits strictly, so an early stop still
/// yields a usable plan. Source: [Rao1998]; structure as measured in docs/REFERENCES.md, QP
/// baseline. Owns all its memory: no allocation.
class RiccatiIpm {
 public:
  explicit RiccatiIpm(const RiccatiIpmParams& params) : params_(params) {}

  /// Poisons `out` with NaN first. Errors: none thrown; see out.status.
  void Solve(const OcpQp& qp, OcpSolution& out) noexcept;

 private:
  static constexpr int kRows = 6;  // inequalities per stance foot

  /// Data of one stage restricted to its stance feet, and the factorisation.
  struct Stage {
    int feet = 0;
    std::array<int, 4> leg{};         // which leg the f-th stance foot is
    Eigen::Matrix<double, 12, 12> B;  // columns of the stance feet
    Vec12 R, r;                       // of the stance feet
    Vec12 u, u_new, r_tilde;
    Eigen::Matrix<double, kRows, 4> slack, lambda, weight, d_slack,
        d_lambda;                                      // one column per foot
    Mat12 L;                                           // Cholesky factor of the input Hessian
    Eigen::Matrix<double, 12, 12, Eigen::RowMajor> Y;  // L⁻¹ BᵀPA
    Vec12 h, Pb;
  };

  void Load(const OcpQp& qp) noexcept;
  void Start(const OcpQp& qp) noexcept;
  [[nodiscard]] double MeanComplementarity() const noexcept;
  void SetGradients(double target, bool corrector) noexcept;
  [[nodiscard]] bool Factorize(const OcpQp& qp) noexcept;
  void SolveForInputs(const OcpQp& qp) noexcept;
  void CalcDirections(double target, bool corrector) noexcept;
  struct StepLengths {
    double primal = 1.0, dual = 1.0;
  };
  [[nodiscard]] StepLengths MaxSteps() const noexcept;
  [[nodiscard]] double ComplementarityAfter(const StepLengths& step) const noexcept;
  void TakeStep(StepLengths step) noexcept;
  void Extract(const OcpQp& qp, OcpSolution& out) const noexcept;

  template <int kFeet>
  [[nodiscard]] bool FactorizeStage(const OcpStage& data, bool euler, Stage& stage) noexcept;
  template <int kFeet>
  void BackwardStage(const OcpStage& data, Stage& stage, Vec12& p) const noexcept;
  template <int kFeet>
  void ForwardStage(const OcpStage& data, Stage& stage, Vec12& x) const noexcept;

  [[nodiscard]] Eigen::Matrix<double, kRows, 1> Slacks(const Vec3& f) const noexcept;

  RiccatiIpmParams params_;
  int horizon_ = 0;
  int num_inequalities_ = 0;
  double friction_ = 0.0, f_min_ = 0.0, f_max_ = 0.0;
  std::array<Stage, kMaxHorizon> stages_;
  Mat12 P_;
};

}  // namespace scoria::controller
