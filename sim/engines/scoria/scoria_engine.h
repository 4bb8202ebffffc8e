// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "sim/engines/scoria/step_solver.h"
#include "sim/plant/engine.h"

namespace scoria::sim {

/// The whole-body model, moved by StepSolver and semi-implicit Euler on the position of B's origin,
/// SO(3) and the joints.
class ScoriaEngine final : public Engine {
 public:
  /// `robot` is borrowed.
  ScoriaEngine(const core::RobotDescription& robot, const SolverParams& params)
      : robot_(robot), solver_(robot, params) {}

  [[nodiscard]] StepResult Step(const StepInput& in, std::span<ContactPoint> contacts) override;
  void Reset() noexcept override { solver_.Reset(); }
  [[nodiscard]] std::unique_ptr<Engine> Clone() const override {
    return std::make_unique<ScoriaEngine>(*this);
  }

 private:
  const core::RobotDescription& robot_;
  StepSolver solver_;
};

}  // namespace scoria::sim
