// SPDX-License-Identifier: BSD-3-Clause
// The rigid-body dynamics against MuJoCo, an independent implementation.
#include <cstdio>
#include <memory>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "controller/model/whole_body.h"
#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kGravity = 9.81;

std::string Numbers(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string Inertial(const core::Body& b) {
  const Mat3& I = b.I_C_L;
  return fmt::format(
      "<inertial pos='{}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
      "{:.17g}'/>",
      Numbers(b.p_LC), b.mass_kg, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
}

/// The robot as a MuJoCo model: free joint, twelve hinges with armature, a site at every foot.
std::string Mjcf(const core::RobotDescription& robot) {
  std::string legs;
  for (const Leg leg : kLegs) {
    const core::LegDescription& l = robot.legs[leg];
    std::string open, close;
    for (std::size_t j = 0; j < 3; ++j) {
      const Quat q(l.joints[j].R_PJ);
      open += fmt::format(
          "<body pos='{}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'>{}<joint type='hinge' axis='{}' "
          "armature='{}'/>",
          Numbers(l.joints[j].p_PJ), q.w(), q.x(), q.y(), q.z(), Inertial(l.links[j]),
          Numbers(l.joints[j].axis_J),
          robot.config.motors.armature_kgm2[static_cast<Eigen::Index>(j)]);
      if (j == 2) open += fmt::format("<site name='{}' pos='{}'/>", LegName(leg), Numbers(l.p_LF));
      close += "</body>";
    }
    legs += open + close;
  }
  return fmt::format(
      "<mujoco><compiler angle='radian' inertiafromgeom='false' boundmass='0' boundinertia='0'/>"
      "<option gravity='0 0 -{}'/><worldbody><body "
      "name='B'><freejoint/>{}{}</body></worldbody></mujoco>",
      kGravity, Inertial(robot.trunk), legs);
}

struct Deleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

class MujocoModel {
 public:
  MujocoModel() {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "go2.xml").string(), xml = Mjcf(test::Go2());
    std::FILE* file = std::fopen(path.c_str(), "w");
    std::fputs(xml.c_str(), file);
    std::fclose(file);
    char error[1000] = "";
    model.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
    if (!model) throw std::runtime_error(error);
    data.reset(mj_makeData(model.get()));
  }

  /// MuJoCo's free joint: linear velocity in W, angular in B.
  void Set(const RobotState& s) {
    const Quat q(s.R_WB);
    const Vec3 w_B = s.R_WB.transpose() * s.w_WB;
    for (int i = 0; i < 3; ++i) {
      data->qpos[i] = s.p_WB[i];
      data->qvel[i] = s.v_WB[i];
      data->qvel[3 + i] = w_B[i];
    }
    data->qpos[3] = q.w();
    data->qpos[4] = q.x();
    data->qpos[5] = q.y();
    data->qpos[6] = q.z();
    const auto angles = Flatten(s.q), rates = Flatten(s.qd);
    for (std::size_t j = 0; j < 12; ++j) {
      data->qpos[7 + j] = angles[j];
      data->qvel[6 + j] = rates[j];
    }
    mj_forward(model.get(), data.get());
  }

  std::unique_ptr<mjModel, Deleter> model;
  std::unique_ptr<mjData, Deleter> data;
};

/// v = T v_mujoco.
Mat18 VelocityMap(const RobotState& s) {
  Mat18 T = Mat18::Identity();
  T.block<3, 3>(3, 3) = s.R_WB;
  return T;
}

class AgainstMujoco : public ::testing::Test {
 protected:
  MujocoModel mujoco;
  WholeBodyModel model{test::Go2(), kGravity};
  WholeBody wb;
  core::Rng rng{21, 0, core::Stream::kSensor};
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
      ours.middleCols<3>(3) = -core::Skew(wb.p_BF_W[leg]);
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
}  // namespace scoria::controller
