// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/tsid_dense.h"
#include "controller/qp/solvers/tsid_nullspace.h"
#include "controller/wbc/whole_body_controller.h"

namespace scoria::controller {

/// Whole-body control by task-space inverse dynamics: tracks COM, trunk orientation, swing feet and
/// MPC forces in a weighted least-squares sense, subject to the equations of motion, non-moving
/// contacts, friction pyramids and torque limits. Contacts roll: the constrained point is the
/// sphere's lowest one, not its centre. Source: paper, whole-body control; differs: a contact that
/// moves is braked (contact_damping_per_s), pyramids stand on the ground plane.
class Tsid final : public WholeBodyController {
 public:
  /// `robot` is borrowed.
  Tsid(const TsidParams& params, const core::RobotDescription& robot);

  [[nodiscard]] WbcResult Solve(const WbcInput& in) noexcept override;
  [[nodiscard]] std::unique_ptr<WholeBodyController> Clone() const override {
    return std::make_unique<Tsid>(*this);
  }

  [[nodiscard]] const TsidRecord* last() const noexcept override { return &last_; }

 private:
  using Mat36 = TsidProblem::Mat36;

  void AddMotion(const WbcInput& in) noexcept;
  void AddForceTasks(const WbcInput& in, const LegArray<Vec3>& f_planned,
                     const BodyReference::Stage& target) noexcept;
  void AddTrunkTask(const WbcInput& in, const LegArray<Vec3>& f_planned,
                    const BodyReference::Stage& target) noexcept;
  void AddSwingTasks(const WbcInput& in) noexcept;
  void AddLimits(const WbcInput& in) noexcept;
  [[nodiscard]] TsidSolution SolveForm(bool limit_torques) noexcept;

  TsidParams params_;
  const core::RobotDescription& robot_;
  LegArray<Vec3> effort_Nm_;
  TsidRecord last_;
  TsidNullspace nullspace_;
  TsidDense dense_;
};

}  // namespace scoria::controller
