// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/state_estimator.h"

#include "controller/estimation/inekf_estimator.h"
#include "controller/estimation/leg_odometry.h"
#include "controller/estimation/linear_kf.h"

namespace scoria::controller {
namespace {

class TruthEstimator final : public StateEstimator {
 public:
  StateEstimate Update(const EstimatorInput& in, Counters&) noexcept override {
    if (in.z.truth) last_.state = in.z.truth->state;
    return last_;
  }
  void Continue(const StateEstimate& from, double) noexcept override {
    last_ = {};
    last_.state = from.state;
    last_.gyro_bias_S = from.gyro_bias_S;  // for the estimator that follows
  }
  std::unique_ptr<StateEstimator> Clone() const override {
    return std::make_unique<TruthEstimator>(*this);
  }

 private:
  StateEstimate last_;
};

}  // namespace

Vec3 StandingPlace(const core::RobotDescription& robot, const Placement& placement,
                   const Mat3& R_WB, const LegArray<Vec3>& q) noexcept {
  double height_m = 0.0;
  for (const Leg leg : kLegs) {
    const core::LegDescription& description = robot.legs[leg];
    const Vec3 p_BF_W = R_WB * core::CalcLegKinematics(description, q[leg]).p_BF;
    height_m += (description.foot_radius_m - p_BF_W.z()) / kNumLegs;
  }
  return {placement.p_WB_xy.x(), placement.p_WB_xy.y(), placement.ground_z_m + height_m};
}

bool NeedsTruth(const EstimatorParams& params) noexcept {
  return std::holds_alternative<TruthEstimatorParams>(params);
}

std::unique_ptr<StateEstimator> MakeStateEstimator(const EstimatorParams& params,
                                                   const core::RobotDescription& robot,
                                                   double gravity_mps2,
                                                   const Placement& placement) {
  struct Maker {
    const core::RobotDescription& robot;
    double gravity_mps2;
    const Placement& placement;
    std::unique_ptr<StateEstimator> operator()(const InekfEstimatorParams& p) const {
      return std::make_unique<InekfEstimator>(p, robot, gravity_mps2, placement);
    }
    std::unique_ptr<StateEstimator> operator()(const LinearKfParams& p) const {
      return std::make_unique<LinearKf>(p, robot, gravity_mps2, placement);
    }
    std::unique_ptr<StateEstimator> operator()(const LegOdometryParams& p) const {
      return std::make_unique<LegOdometry>(p, robot, placement);
    }
    std::unique_ptr<StateEstimator> operator()(const TruthEstimatorParams&) const {
      return std::make_unique<TruthEstimator>();
    }
  };
  return std::visit(Maker{robot, gravity_mps2, placement}, params);
}

}  // namespace scoria::controller
