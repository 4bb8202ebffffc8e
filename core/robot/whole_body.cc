// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/whole_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/math/so3.h"

namespace scoria::core {
namespace {

/// Rotation about a unit axis; the axes of legs are mostly coordinate axes, where this is exact.
Mat3 AxisRotation(const Vec3& axis, double angle) noexcept {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Motion of a link at zero generalised acceleration: `o` joint origin from B's origin, `a_o` its
/// acceleration, which starts from +g at the trunk so that gravity enters every force below.
struct LinkMotion {
  Mat3 R;
  Vec3 o, w, alpha, v_o, a_o, z;
};

struct Wrench {
  Vec3 f = Vec3::Zero(), t = Vec3::Zero();  // t about B's origin
};

/// Force that moves a body as `m` says; its inertia is from B's origin, in W.
Wrench InertialWrench(const SpatialInertia& body, const LinkMotion& m) noexcept {
  const Vec3 oc = body.p_OC - m.o;
  Wrench out;
  out.f = body.mass_kg * (m.a_o + m.alpha.cross(oc) + m.w.cross(m.w.cross(oc)));
  out.t = body.I_C * m.alpha + m.w.cross(body.I_C * m.w) + body.p_OC.cross(out.f);
  return out;
}

LinkMotion StepToLink(const LinkMotion& parent, const JointDescription& joint, double q,
                      double qd) noexcept {
  LinkMotion m;
  const Vec3 d = parent.R * joint.p_PJ;
  const Mat3 R_WJ = parent.R * joint.R_PJ;
  m.z = R_WJ * joint.axis_J;
  m.R = R_WJ * AxisRotation(joint.axis_J, q);
  m.o = parent.o + d;
  m.w = parent.w + m.z * qd;
  m.alpha = parent.alpha + parent.w.cross(m.z) * qd;
  m.v_o = parent.v_o + parent.w.cross(d);
  m.a_o = parent.a_o + parent.alpha.cross(d) + parent.w.cross(parent.w.cross(d));
  return m;
}

SpatialInertia InWorld(const SpatialInertia& body, const LinkMotion& m) noexcept {
  return Transform(m.R, m.o, body);
}

void CalcFoot(const LegDescription& leg, const std::array<LinkMotion, 3>& links, Leg which,
              const Vec3& gravity_W, WholeBody& out) noexcept {
  const LinkMotion& shank = links[2];
  const Vec3 r = shank.R * leg.p_LF;
  const Vec3 p_BF_W = shank.o + r;
  out.p_BF_W[which] = p_BF_W;
  out.p_WF[which] = out.state.p_WB + p_BF_W;
  out.v_WF[which] = shank.v_o + shank.w.cross(r);
  out.Jd_v[which] = shank.a_o + shank.alpha.cross(r) + shank.w.cross(shank.w.cross(r)) + gravity_W;
  out.w_shank_W[which] = shank.w;
  out.Jwd_v[which] = shank.alpha;
  for (int j = 0; j < 3; ++j) {
    const LinkMotion& link = links[static_cast<std::size_t>(j)];
    out.J_ll[which].col(j) = link.z.cross(p_BF_W - link.o);
    out.Jw_ll[which].col(j) = link.z;
    out.p_BJ_W[which].col(j) = link.o;
  }
}

}  // namespace

WholeBodyModel::WholeBodyModel(const RobotDescription& robot, const Vec3& gravity_W)
    : robot_(robot), gravity_W_(gravity_W), parameters_{robot.trunk} {}

void WholeBodyModel::SetParameters(const ModelParameters& parameters) noexcept {
  parameters_ = parameters;
}

void WholeBodyModel::Calc(const RobotState& state, WholeBody& out) const noexcept {
  out.state = state;
  const LinkMotion trunk{state.R_WB, Vec3::Zero(), state.w_WB, Vec3::Zero(),
                         state.v_WB, -gravity_W_,  {}};
  SpatialInertia total = InWorld(parameters_.trunk, trunk);
  Wrench total_wrench = InertialWrench(total, trunk);
  Vec3 momentum = total.mass_kg * (state.v_WB + state.w_WB.cross(total.p_OC));

  for (const Leg leg : kLegs) {
    const LegDescription& description = robot_.legs[leg];
    std::array<LinkMotion, 3> links;
    std::array<SpatialInertia, 3> bodies;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      links[j] = StepToLink(j == 0 ? trunk : links[j - 1], description.joints[j], state.q[leg][k],
                            state.qd[leg][k]);
      bodies[j] = InWorld(description.links[j], links[j]);
      momentum +=
          bodies[j].mass_kg * (links[j].v_o + links[j].w.cross(bodies[j].p_OC - links[j].o));
    }
    CalcFoot(description, links, leg, gravity_W_, out);

    // Tip to root: composites give H, wrenches give h.
    SpatialInertia outer = bodies[2];
    Wrench wrench = InertialWrench(bodies[2], links[2]);
    for (std::size_t j = 3; j-- > 0;) {
      if (j < 2) {
        outer = Join(bodies[j], outer);
        const Wrench own = InertialWrench(bodies[j], links[j]);
        wrench.f += own.f;
        wrench.t += own.t;
      }
      const auto col = static_cast<Eigen::Index>(j);
      const LinkMotion& link = links[j];
      out.h_l[leg][col] = link.z.dot(wrench.t - link.o.cross(wrench.f));
      const Vec3 f = outer.mass_kg * link.z.cross(outer.p_OC - link.o);  // force for unit qdd_j
      const Vec3 t = outer.I_C * link.z + outer.p_OC.cross(f);
      out.H_Bl[leg].col(col) << f, t;
      for (std::size_t k = 0; k <= j; ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        const double h = links[k].z.dot(t - links[k].o.cross(f));
        out.H_ll[leg](row, col) = out.H_ll[leg](col, row) = h;
      }
    }
    out.H_ll[leg].diagonal() += robot_.config.motors.armature_kgm2;
    total = Join(total, outer);
    total_wrench.f += wrench.f;
    total_wrench.t += wrench.t;
  }

  out.mass_kg = total.mass_kg;
  out.p_WC = state.p_WB + total.p_OC;
  out.v_WC = momentum / total.mass_kg;
  out.I_C_W = total.I_C;
  const Mat3 S = Skew(total.p_OC);
  out.H_BB.topLeftCorner<3, 3>() = total.mass_kg * Mat3::Identity();
  out.H_BB.topRightCorner<3, 3>() = -total.mass_kg * S;
  out.H_BB.bottomLeftCorner<3, 3>() = total.mass_kg * S;
  out.H_BB.bottomRightCorner<3, 3>() = total.I_C + PointInertia(total.mass_kg, total.p_OC);
  out.h_B << total_wrench.f, total_wrench.t;
}

LegKinematics CalcLegKinematics(const LegDescription& leg, const Vec3& q) noexcept {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
  std::array<Vec3, 3> o, z;
  for (std::size_t j = 0; j < 3; ++j) {
    const JointDescription& joint = leg.joints[j];
    p += R * joint.p_PJ;
    R *= joint.R_PJ;
    o[j] = p;
    z[j] = R * joint.axis_J;
    R *= AxisRotation(joint.axis_J, q[static_cast<Eigen::Index>(j)]);
  }
  LegKinematics out;
  out.p_BF = p + R * leg.p_LF;
  for (std::size_t j = 0; j < 3; ++j) {
    out.J.col(static_cast<Eigen::Index>(j)) = z[j].cross(out.p_BF - o[j]);
  }
  return out;
}

Vec3 SolveLegIk(const LegDescription& leg, const Vec3& p_BF, const Vec3& q_guess) noexcept {
  constexpr int kMaxIterations = 60;
  constexpr double kDamping_m = 1e-3, kTolerance_m = 1e-10, kMaxStep_rad = 0.3;
  Vec3 q = q_guess, best = q_guess;
  double best_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxIterations; ++i) {
    const LegKinematics k = CalcLegKinematics(leg, q);
    const Vec3 error = p_BF - k.p_BF;
    if (error.norm() < best_m) {
      best_m = error.norm();
      best = q;
    }
    if (best_m < kTolerance_m) break;
    const double damping = std::min(kDamping_m, error.norm());  // vanishes as the root nears
    const Mat3 A = k.J * k.J.transpose() + damping * damping * Mat3::Identity();
    Vec3 step = k.J.transpose() * A.inverse() * error;
    if (step.norm() > kMaxStep_rad) step *= kMaxStep_rad / step.norm();
    q += step;
    for (std::size_t j = 0; j < 3; ++j) {
      double& angle = q[static_cast<Eigen::Index>(j)];
      angle = std::clamp(angle, leg.joints[j].lower_rad, leg.joints[j].upper_rad);
    }
  }
  return best;
}

double CalcKineticEnergy(const WholeBody& wb) noexcept {
  Vec6 v_B;
  v_B << wb.state.v_WB, wb.state.w_WB;
  double twice = v_B.dot(wb.H_BB * v_B);
  for (const Leg leg : kLegs) {
    const Vec3& qd = wb.state.qd[leg];
    twice += 2.0 * v_B.dot(wb.H_Bl[leg] * qd) + qd.dot(wb.H_ll[leg] * qd);
  }
  return 0.5 * twice;
}

Vec6 CalcMomentum(const WholeBody& wb) noexcept {
  Vec6 v_B;
  v_B << wb.state.v_WB, wb.state.w_WB;
  Vec6 momentum = wb.H_BB * v_B;  // angular about B's origin
  for (const Leg leg : kLegs) momentum += wb.H_Bl[leg] * wb.state.qd[leg];
  momentum.tail<3>() -= (wb.p_WC - wb.state.p_WB).cross(momentum.head<3>());
  return momentum;
}

Mat18 AssembleMassMatrix(const WholeBody& wb) noexcept {
  Mat18 H = Mat18::Zero();
  H.topLeftCorner<6, 6>() = wb.H_BB;
  for (const Leg leg : kLegs) {
    const Eigen::Index at = 6 + 3 * static_cast<Eigen::Index>(leg);
    H.block<6, 3>(0, at) = wb.H_Bl[leg];
    H.block<3, 6>(at, 0) = wb.H_Bl[leg].transpose();
    H.block<3, 3>(at, at) = wb.H_ll[leg];
  }
  return H;
}

Vec18 AssembleBias(const WholeBody& wb) noexcept {
  Vec18 h;
  h.head<6>() = wb.h_B;
  for (const Leg leg : kLegs) h.segment<3>(6 + 3 * static_cast<Eigen::Index>(leg)) = wb.h_l[leg];
  return h;
}

}  // namespace scoria::core
