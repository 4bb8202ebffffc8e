// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <variant>

#include "controller/qp/problems/tsid_problem.h"
#include "controller/qp/status.h"
#include "controller/wbc/inverse_dynamics_params.h"
#include "controller/wbc/tsid_params.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct WbcInput {
  const core::WholeBody& wb;
  const LegPhases& legs;
  const FootTargets& feet;
  const ForcePlan& forces;
  double plan_age_s;  // since the state that `forces` was planned from
  const Vec3& n_W;    // ground normal
};

struct WbcResult {
  JointCommand command;
  LegArray<Vec3> f_F_W = ZeroPerLeg();  // forces that the solution expects
  BodyReference::Stage target;          // body target of this tick
  SolveStatus status = SolveStatus::kNumerical;
  bool torque_rows_dropped = false;  // infeasible with torque limits: solved without, then clamped
  bool singular_leg = false;         // a stance leg was stretched: solved by the dense form
  int iterations = 0;
};

/// From body motion and forces that were planned to motor commands, at wbc_Hz.
class WholeBodyController {
 public:
  virtual ~WholeBodyController() = default;
  [[nodiscard]] virtual WbcResult Solve(const WbcInput& in) noexcept = 0;
  /// A copy that goes on with the same bits; what is borrowed stays borrowed.
  [[nodiscard]] virtual std::unique_ptr<WholeBodyController> Clone() const = 0;
  /// The last problem with its solution, for saving; null where there is no optimisation.
  [[nodiscard]] virtual const TsidRecord* last() const noexcept { return nullptr; }
};

using WbcParams = std::variant<TsidParams, InverseDynamicsParams>;

/// `robot` is borrowed.
[[nodiscard]] std::unique_ptr<WholeBodyController> MakeWholeBodyController(
    const WbcParams& params, const core::RobotDescription& robot);

}  // namespace scoria::controller
