// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "controller/estimation/inekf_estimator_params.h"
#include "controller/estimation/leg_odometry_params.h"
#include "controller/estimation/linear_kf_params.h"
#include "core/config/field.h"
#include "core/robot/contact.h"
#include "core/robot/counters.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Robot state as the controller believes it.
struct StateEstimate {
  using Mat5 = Eigen::Matrix<double, 5, 5>;
  RobotState state;
  bool ready = true;  // false until the attitude was found at rest
  /// Of the tilt about x and y of W [rad] and of the velocity [m/s] in W, both as right-invariant
  /// errors; zero where the estimator has none.
  Mat5 P_tilt_v = Mat5::Zero();
  std::optional<Vec3> gyro_bias_S;  // rad/s, where one was learned
  double nis = 0.0;  // normalised innovation squared of the last correction by the feet
  int nis_dof = 0;   // 0: no correction
};

/// Where the robot was put down, as the operator tells it: its estimate starts there.
struct Placement {
  Vec2 p_WB_xy = Vec2::Zero();
  double ground_z_m = 0.0, yaw_rad = 0.0;
};

/// Where B is when the feet stand level at the placement's ground.
[[nodiscard]] Vec3 StandingPlace(const core::RobotDescription& robot, const Placement& placement,
                                 const Mat3& R_WB, const LegArray<Vec3>& q) noexcept;

struct EstimatorInput {
  const SensorFrame& z;   // checked: finite
  double imu_dt_s = 0.0;  // that the IMU sample covers; 0: there is no new one
  bool imu_saturated = false;
  const ContactEstimate& contact;
  const core::WholeBody& wb;  // at the last tick
  Vec3 n_W = Vec3::UnitZ();   // of the ground
  bool at_rest = false;       // the robot stands or lies still and waits for its attitude
};

/// One call per physics step.
class StateEstimator {
 public:
  virtual ~StateEstimator() = default;
  [[nodiscard]] virtual StateEstimate Update(const EstimatorInput& in,
                                             Counters& counters) noexcept = 0;
  /// Goes on from a state: another estimator's, or its own that does not fit any more. Keeps the
  /// gyro bias that was learned.
  /// @param sigma_scale  of the standard deviations at the start. The covariance that `from` states
  /// comes on top; where it states none, that of a baseline without one is assumed.
  virtual void Continue(const StateEstimate& from, double sigma_scale) noexcept = 0;
  /// A copy that goes on with the same bits; what is borrowed stays borrowed.
  [[nodiscard]] virtual std::unique_ptr<StateEstimator> Clone() const = 0;
};

/// The simulator's own state, for controller studies without estimation error.
struct TruthEstimatorParams {
  static constexpr const char* kType = "truth";
  template <class Archive>
  void Serialize(Archive&) {}
  bool operator==(const TruthEstimatorParams&) const = default;
};

using EstimatorParams =
    std::variant<InekfEstimatorParams, LinearKfParams, LegOdometryParams, TruthEstimatorParams>;

/// @returns true if the estimator needs SensorFrame::truth.
[[nodiscard]] bool NeedsTruth(const EstimatorParams& params) noexcept;

/// @param robot borrowed.
[[nodiscard]] std::unique_ptr<StateEstimator> MakeStateEstimator(
    const EstimatorParams& params, const core::RobotDescription& robot, double gravity_mps2,
    const Placement& placement);

}  // namespace scoria::controller
