// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/robot_multibody.h"

#include <limits>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <Eigen/Eigenvalues>

#include "sim/bullet_vectors.h"

static_assert(sizeof(btScalar) == 8, "scoria needs Bullet in double precision (bullet-float64)");

namespace scoria::sim {
namespace {

using core::kNumBodies;

btQuaternion ToQuaternion(const Mat3& R) {
  const Quat q = Quat(R).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}
Mat3 ToMat3(const btQuaternion& q) {
  return Quat(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
}

/// Principal axes of an inertia, as the columns of R_LD, and its moments about them.
struct Principal {
  Mat3 R_LD = Mat3::Identity();
  Vec3 moments = Vec3::Zero();
};

Principal FindPrincipal(const Mat3& I_C) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(I_C);
  Principal out{solver.eigenvectors(), solver.eigenvalues()};
  if (out.R_LD.determinant() < 0.0) out.R_LD.col(2) *= -1.0;
  return out;
}

/// Bullet's index of a link: the trunk is no link, but the base.
int LinkIndex(int body_index) { return body_index - 1; }
int JointIndex(Leg leg, int joint) {
  return LinkIndex(core::BodyIndex(leg, static_cast<Joint>(joint)));
}

}  // namespace

RobotMultiBody::RobotMultiBody(const core::RobotDescription& robot,
                               const core::SpatialInertia& trunk)
    : trunk_(trunk) {
  std::array<Principal, kNumBodies> principal;
  std::array<Vec3, kNumBodies> p_LC;
  for (int b = 0; b < kNumBodies; ++b) {
    const core::SpatialInertia& link = robot.body(b);
    const core::SpatialInertia& inertia = b == 0 ? trunk_ : link;
    principal[static_cast<std::size_t>(b)] = FindPrincipal(inertia.I_C);
    p_LC[static_cast<std::size_t>(b)] = inertia.p_OC;
  }
  R_BD_ = principal[0].R_LD;
  body_ = std::make_unique<btMultiBody>(kNumJoints, trunk_.mass_kg, ToBullet(principal[0].moments),
                                        false, false);
  for (int b = 1; b < kNumBodies; ++b) {
    const auto joint = static_cast<std::size_t>(core::JointOf(b));
    const core::JointDescription& j = robot.legs[core::LegOf(b)].joints[joint];
    const int parent = joint == 0 ? 0 : b - 1;
    const auto child = static_cast<std::size_t>(b), from = static_cast<std::size_t>(parent);
    const Mat3 R_DL = principal[child].R_LD.transpose(), R_DP = principal[from].R_LD.transpose();
    const Mat3 R_parent_child = R_DP * j.R_PJ * principal[child].R_LD;
    body_->setupRevolute(LinkIndex(b), robot.body(b).mass_kg, ToBullet(principal[child].moments),
                         LinkIndex(parent), ToQuaternion(R_parent_child.transpose()),
                         ToBullet(R_DL * j.axis_J), ToBullet(R_DP * (j.p_PJ - p_LC[from])),
                         ToBullet(R_DL * p_LC[child]), true);
  }
  body_->finalizeMultiDof();
  body_->setLinearDamping(0.0);
  body_->setAngularDamping(0.0);
  body_->setMaxCoordinateVelocity(std::numeric_limits<double>::max());
  body_->setHasSelfCollision(false);
  for (int b = 0; b < kNumBodies; ++b) {
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(body_.get(), LinkIndex(b)));
    if (b == 0) {
      body_->setBaseCollider(colliders_.back().get());
    } else {
      body_->getLink(LinkIndex(b)).m_collider = colliders_.back().get();
    }
  }
}

RobotMultiBody::~RobotMultiBody() = default;

void RobotMultiBody::SetState(const RobotState& s) {
  const Vec3 p_BD_W = s.R_WB * trunk_.p_OC;
  body_->setBasePos(ToBullet(s.p_WB + p_BD_W));
  body_->setWorldToBaseRot(ToQuaternion((s.R_WB * R_BD_).transpose()));
  body_->setBaseVel(ToBullet(s.v_WB + s.w_WB.cross(p_BD_W)));
  body_->setBaseOmega(ToBullet(s.w_WB));
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      body_->setJointPos(JointIndex(leg, j), s.q[leg][j]);
      body_->setJointVel(JointIndex(leg, j), s.qd[leg][j]);
    }
  }
}

RobotState RobotMultiBody::state() const {
  RobotState s;
  s.R_WB = (R_BD_ * ToMat3(body_->getWorldToBaseRot())).transpose();
  s.w_WB = ToVec3(body_->getBaseOmega());
  const Vec3 p_BD_W = s.R_WB * trunk_.p_OC;
  s.p_WB = ToVec3(body_->getBasePos()) - p_BD_W;
  s.v_WB = ToVec3(body_->getBaseVel()) - s.w_WB.cross(p_BD_W);
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      s.q[leg][j] = body_->getJointPos(JointIndex(leg, j));
      s.qd[leg][j] = body_->getJointVel(JointIndex(leg, j));
    }
  }
  return s;
}

}  // namespace scoria::sim
