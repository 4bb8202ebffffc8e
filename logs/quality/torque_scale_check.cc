// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/torque_scale_check.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "core/math/so3.h"
#include "logs/quality/leg_load.h"
#include "logs/quality/resampler.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {
namespace {

using Sums = TorqueScaleCheck::Sums;

constexpr double kScaleSpan_s = 4.0 * kTick_s;
/// Instants at which a foot hits the ground tell little: the trunk is not rigid then.
constexpr double kLeastForce = 0.5, kMostForce = 1.5;  // specific, of gravity
constexpr double kUpright = 0.8;                       // cosine of the largest tilt
/// More than elsewhere: what the model leaves out is the same with every stride, which standard
/// errors do not see.
constexpr double kSure_t = 2.0 * kSureAbove_t;
constexpr double kFrictionRate_radps = 0.1;  // below it friction fades out

/// With a scale for each kind of joint, and one for joint `own` of 12.
struct OwnScale {
  double left = 0.0;   // sum of squares
  double ratio = 0.0;  // logarithm of what its torque is to what it should be, by the others
};

/// Nothing where the equations do not tell the scales, or one is not positive.
std::optional<OwnScale> FitOwnScale(const Sums& sums, Eigen::Index own) {
  constexpr double kLeastCondition = 1e-6;
  Eigen::Matrix<double, 12, 4> kinds = Eigen::Matrix<double, 12, 4>::Zero();
  for (Eigen::Index i = 0; i < kinds.rows(); ++i)
    kinds(i, i == own ? Eigen::Index(3) : i % kJointsPerLeg) = 1.0;
  const Eigen::LDLT<Eigen::Matrix4d> solver(kinds.transpose() * sums.A * kinds);
  if (solver.rcond() < kLeastCondition) return std::nullopt;
  const Eigen::Vector4d y = kinds.transpose() * sums.y, scales = solver.solve(y);
  if (!(scales.minCoeff() > 0.0)) return std::nullopt;
  return OwnScale{sums.squares - y.dot(scales), std::log(scales[own % kJointsPerLeg] / scales[3])};
}

/// The joint that explains most, if all others are as their kinds.
struct Suspect {
  Eigen::Index joint = 0;
  OwnScale scale;
};

std::optional<Suspect> FindSuspect(const Sums& sums) {
  std::optional<Suspect> best;
  for (Eigen::Index i = 0; i < 12; ++i) {
    const auto own = FitOwnScale(sums, i);
    if (!own) return std::nullopt;
    if (!best || own->left < best->scale.left) best = Suspect{i, *own};
  }
  return best;
}

}  // namespace

TorqueScaleCheck::TorqueScaleCheck(const LogSubject& subject) : subject_(subject) {
  if (subject.robot != nullptr) model_.emplace(*subject.robot, subject.gravity_mps2);
}

void TorqueScaleCheck::AddTick(const Tick& tick) {
  if (!model_) return;
  last_.Add(tick);
  if (last_.IsFull()) AddEquations(last_[0], last_[2], last_[4]);
}

/// Acceleration of the trunk [linear; angular] in W, by accelerometer and gyroscope, else by the
/// velocities of truth or estimate. Nothing where neither is known, and while the trunk is hit.
std::optional<Vec6> TorqueScaleCheck::AccelerationOf(const Tick& before, const Tick& now,
                                                     const Tick& after) const {
  const auto R_WB = AttitudeOf(now);
  const auto w = RateOf(now), w_before = RateOf(before), w_after = RateOf(after);
  if (!R_WB || !w || !w_before || !w_after) return std::nullopt;
  const Vec3 g_W = subject_.gravity_mps2 * Vec3::UnitZ();
  const Vec3 alpha_B = (*w_after - *w_before) / kScaleSpan_s;
  Vec6 a;
  a.tail<3>() = *R_WB * alpha_B;
  const auto v_before = VelocityOf(before), v_after = VelocityOf(after);
  if (now.a_WS_B) {
    const Vec3& p_BS = subject_.robot->p_BS;
    a.head<3>() = *R_WB * (*now.a_WS_B - alpha_B.cross(p_BS) - w->cross(w->cross(p_BS))) - g_W;
  } else if (v_before && v_after) {
    a.head<3>() = (*v_after - *v_before) / kScaleSpan_s;
  } else {
    return std::nullopt;
  }
  const double force = (a.head<3>() + g_W).norm() / subject_.gravity_mps2;
  const bool is_usual = force > kLeastForce && force < kMostForce && (*R_WB)(2, 2) > kUpright;
  return is_usual ? std::optional(a) : std::nullopt;
}

void TorqueScaleCheck::AddEquations(const Tick& before, const Tick& now, const Tick& after) {
  if (!now.q || !now.qd || !now.tau || !before.qd || !after.qd) return;
  const auto acceleration = AccelerationOf(before, now, after);
  if (!acceleration) return;
  const Vec6& a = *acceleration;
  RobotState state;
  state.R_WB = *AttitudeOf(now);
  state.w_WB = state.R_WB * *RateOf(now);
  state.q = *now.q;
  state.qd = *now.qd;
  core::WholeBody wb;
  model_->Calc(state, wb);

  const core::MotorParams& motors = subject_.robot->config.motors;
  const double length_m = LegLength(subject_.robot->legs[Leg::kFL]);
  const double least = kLeastDeterminant * length_m * length_m * length_m / 8.0;
  Eigen::Matrix<double, 6, 12> X;
  Vec6 y = wb.H_BB * a + wb.h_B;
  for (const Leg leg : kLegs) {
    if (std::abs(wb.J_ll[leg].determinant()) < least) return;
    const Vec3 qdd = ((*after.qd)[leg] - (*before.qd)[leg]) / kScaleSpan_s, qd = state.qd[leg];
    const Mat3 J_inverse = wb.J_ll[leg].transpose().inverse();
    Eigen::Matrix<double, 6, 3> on_trunk;
    on_trunk << J_inverse, core::Skew(wb.p_BF_W[leg]) * J_inverse;
    const Vec3 friction =
        motors.damping_Nms_per_rad.cwiseProduct(qd) +
        motors.friction_Nm.cwiseProduct((qd / kFrictionRate_radps).array().tanh().matrix());
    y += wb.H_Bl[leg] * qdd -
         on_trunk * (wb.H_Bl[leg].transpose() * a + wb.H_ll[leg] * qdd + wb.h_l[leg] + friction);
    X.middleCols<3>(kJointsPerLeg * static_cast<int>(leg)) =
        -on_trunk * (*now.tau)[leg].asDiagonal();
  }
  // Moments count as forces at half a leg's length.
  X.bottomRows<3>() *= 2.0 / length_m;
  y.tail<3>() *= 2.0 / length_m;
  Sums& sums = groups_[ticks_++ / kBlock % kGroups];
  sums.A += X.transpose() * X;
  sums.y += X.transpose() * y;
  sums.squares += y.squaredNorm();
}

std::optional<double> TorqueScaleCheck::ErrorOf(const Sums& all, Eigen::Index joint) const {
  double mean = 0.0, squares = 0.0;
  for (const Sums& group : groups_) {
    const auto without =
        FitOwnScale({all.A - group.A, all.y - group.y, all.squares - group.squares}, joint);
    if (!without) return std::nullopt;
    mean += without->ratio / kGroups;
    squares += without->ratio * without->ratio / kGroups;
  }
  return std::sqrt((kGroups - 1.0) * std::max(0.0, squares - mean * mean));
}

std::vector<Finding> TorqueScaleCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (ticks_ < kGroups * kBlock / 2 ||
      HasError(earlier,
               {FindingKind::kDegrees, FindingKind::kQuaternionOrder, FindingKind::kAttitudeSign,
                FindingKind::kRollPitchSwapped, FindingKind::kJointSign, FindingKind::kLegOrder,
                FindingKind::kJointOffset, FindingKind::kJointOrder, FindingKind::kTorqueSign,
                FindingKind::kGravityUnit, FindingKind::kGravityMissing, FindingKind::kGravitySign,
                FindingKind::kImuDelay}))
    return {};
  Sums all;
  for (const Sums& group : groups_)
    all.A += group.A, all.y += group.y, all.squares += group.squares;
  const auto suspect = FindSuspect(all);
  if (!suspect) return {};
  const auto error = ErrorOf(all, suspect->joint);
  if (!error) return {};
  const double ratio = suspect->scale.ratio;
  if (std::abs(ratio) < std::log(kWarning) || std::abs(ratio) < kSure_t * *error) return {};
  const bool is_error = std::abs(ratio) > std::log(kError);
  Finding f = MakeFinding(is_error ? Severity::kError : Severity::kWarning,
                          FindingKind::kTorqueScale, SignalId::kJointTau);
  f.leg = kLegs[static_cast<std::size_t>(suspect->joint / kJointsPerLeg)];
  f.joint = static_cast<Joint>(suspect->joint % kJointsPerLeg);
  f.size = std::exp(ratio);
  f.evidence = fmt::format(
      "its torque is {:.2f} times that of the other legs' same joints, for the motion of the trunk "
      "that they cause ({:.0f} standard errors)",
      *f.size, std::min(std::abs(ratio) / *error, 99.0));
  f.repair = "calibration of this joint's torque";
  return {f};
}

}  // namespace scoria::logs
