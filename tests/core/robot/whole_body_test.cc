// SPDX-License-Identifier: BSD-3-Clause
// The rigid-body dynamics against MuJoCo, an independent implementation.
#include "core/robot/whole_body.h"

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/mujoco.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kGravity = 9.81;

/// v = T v_mujoco.
Mat18 VelocityMap(const RobotState& s) {
  Mat18 T = Mat18::Identity();
  T.block<3, 3>(3, 3) = s.R_WB;
  return T;
}

class AgainstMujoco : public ::testing::Test {
 protected:
  test::MujocoModel mujoco{test::Go2(), {.gravity_mps2 = kGravity}};
  WholeBodyModel model{test::Go2(), kGravity};
  WholeBody wb;
  Rng rng{21, 0, Stream::kSensor};
};

TEST_F(AgainstMujoco, MassMatrixWithArmatureAndBias) {
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState s = test::RandomState(rng);
    mujoco.Set(s);
    model.Calc(s, wb);
    const Mat18 T = VelocityMap(s);
    RowMajor H(18, 18);
    mj_fullM(mujoco.model.get(), H.data(), mujoco.data->qM);
    EXPECT_LT((T.transpose() * AssembleMassMatrix(wb) * T - H).lpNorm<Eigen::Infinity>(), 1e-6)
        << trial;
    const Eigen::Map<const Vec18> h(mujoco.data->qfrc_bias);
    EXPECT_LT((T.transpose() * AssembleBias(wb) - h).lpNorm<Eigen::Infinity>(),
              1e-6 * (1.0 + h.norm()))
        << trial;
  }
}

TEST_F(AgainstMujoco, CentreOfMassAndFootJacobians) {
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState s = test::RandomState(rng);
    mujoco.Set(s);
    model.Calc(s, wb);
    mj_subtreeVel(mujoco.model.get(), mujoco.data.get());
    EXPECT_LT((wb.p_WC - Eigen::Map<const Vec3>(mujoco.data->subtree_com + 3)).norm(), 1e-9);
    EXPECT_LT((wb.v_WC - Eigen::Map<const Vec3>(mujoco.data->subtree_linvel + 3)).norm(), 1e-9);
    const Mat18 T = VelocityMap(s);
    for (const Leg leg : kLegs) {
      const int site =
          mj_name2id(mujoco.model.get(), mjOBJ_SITE, std::string(LegName(leg)).c_str());
      RowMajor J(3, 18), Jw(3, 18);
      mj_jacSite(mujoco.model.get(), mujoco.data.get(), J.data(), Jw.data(), site);
      Eigen::Matrix<double, 3, 18> ours = Eigen::Matrix<double, 3, 18>::Zero(), ours_w = ours;
      const int at = 6 + 3 * static_cast<int>(leg);
      ours.leftCols<3>().setIdentity();
      ours.middleCols<3>(3) = -Skew(wb.p_BF_W[leg]);
      ours.middleCols<3>(at) = wb.J_ll[leg];
      ours_w.middleCols<3>(3).setIdentity();
      ours_w.middleCols<3>(at) = wb.Jw_ll[leg];
      EXPECT_LT((ours * T - J).lpNorm<Eigen::Infinity>(), 1e-9);
      EXPECT_LT((ours_w * T - Jw).lpNorm<Eigen::Infinity>(), 1e-9);
      EXPECT_LT((wb.p_WF[leg] - Eigen::Map<const Vec3>(mujoco.data->site_xpos + 3 * site)).norm(),
                1e-9);
    }
  }
}

TEST_F(AgainstMujoco, FootAccelerationAtZeroGeneralisedAcceleration) {
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState s = test::RandomState(rng);
    mujoco.Set(s);
    model.Calc(s, wb);
    mju_zero(mujoco.data->qacc, 18);
    mj_rnePostConstraint(mujoco.model.get(), mujoco.data.get());
    for (const Leg leg : kLegs) {
      const int site =
          mj_name2id(mujoco.model.get(), mjOBJ_SITE, std::string(LegName(leg)).c_str());
      double acceleration[6];  // angular, linear; world axes; gravity appears as an upward
                               // acceleration
      mj_objectAcceleration(mujoco.model.get(), mujoco.data.get(), mjOBJ_SITE, site, acceleration,
                            0);
      const Vec3 a = Eigen::Map<const Vec3>(acceleration + 3) - Vec3(0, 0, kGravity);
      EXPECT_LT((wb.Jd_v[leg] - a).norm(), 1e-6 * (1.0 + a.norm())) << trial;
      EXPECT_LT((wb.Jwd_v[leg] - Eigen::Map<const Vec3>(acceleration)).norm(),
                1e-6 * (1.0 + wb.Jwd_v[leg].norm()))
          << trial;
    }
  }
}

}  // namespace
}  // namespace scoria::core
