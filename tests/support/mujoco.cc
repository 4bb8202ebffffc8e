// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mujoco.h"

#include <cstdio>

#include <fmt/format.h>

#include "tests/support/robots.h"

namespace scoria::test {
namespace {

std::string Numbers(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string Numbers(const Mat3& R) {
  const Quat q(R);
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", q.w(), q.x(), q.y(), q.z());
}

std::string Inertial(const core::Body& b) {
  const Mat3& I = b.I_C;
  return fmt::format(
      "<inertial pos='{}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
      "{:.17g}'/>",
      Numbers(b.p_OC), b.mass_kg, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
}

/// Collision geometry of one body, as the simulator has it: cylinders become capsules.
std::string Geoms(const core::RobotDescription& robot, int body) {
  std::string xml;
  for (const core::Shape& s : robot.collisions) {
    if (s.body != body) continue;
    using Kind = core::Shape::Kind;
    const std::string size =
        s.kind == Kind::kBox ? fmt::format("type='box' size='{}'", Numbers(Vec3(0.5 * s.size_m)))
        : s.kind == Kind::kSphere
            ? fmt::format("type='sphere' size='{:.17g}'", s.size_m.x())
            : fmt::format("type='capsule' size='{:.17g} {:.17g}'", s.size_m.x(),
                          std::max(1e-3, 0.5 * s.size_m.y() - s.size_m.x()));
    xml += fmt::format("<geom {} pos='{}' quat='{}' contype='1' conaffinity='2'/>", size,
                       Numbers(s.p_LG), Numbers(s.R_LG));
  }
  return xml;
}

/// A body of its own, so that MuJoCo and not scoria joins it to the trunk.
std::string PayloadXml(const sim::PayloadParams& p) {
  const bool is_box = p.size_m != Vec3::Zero() && p.inertia_kgm2 == Vec3::Zero();
  const std::string inertia =
      is_box
          ? fmt::format("<geom type='box' size='{}' mass='{:.17g}' contype='0' conaffinity='0'/>",
                        Numbers(Vec3(0.5 * p.size_m)), p.mass_kg)
          : fmt::format("<inertial pos='0 0 0' mass='{:.17g}' diaginertia='{}'/>", p.mass_kg,
                        Numbers(p.inertia_kgm2));
  return fmt::format("<body pos='{}' euler='{}'>{}</body>", Numbers(p.p_BP_m), Numbers(p.rpy_rad),
                     inertia);
}

std::string SlidingXml(const sim::SlidingPayloadParams& p) {
  return fmt::format(
      "<body pos='{}'><joint type='slide' axis='{}' stiffness='{}' damping='{}'/>"
      "<inertial pos='0 0 0' mass='{:.17g}' diaginertia='1e-10 1e-10 1e-10'/></body>",
      Numbers(p.p_BP_m), Numbers(p.axis), p.stiffness_N_per_m, p.damping_Ns_per_m, p.mass_kg);
}

std::string LegXml(const core::RobotDescription& robot, Leg leg, const MujocoOptions& options) {
  const core::LegDescription& l = robot.legs[leg];
  const core::MotorParams& motors = robot.config.motors;
  std::string open, close;
  for (int j = 0; j < kJointsPerLeg; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const std::string losses =
        options.joint_losses ? fmt::format("damping='{}' frictionloss='{}'",
                                           motors.damping_Nms_per_rad[j], motors.friction_Nm[j])
                             : "";
    open +=
        fmt::format("<body pos='{}' quat='{}'>{}<joint type='hinge' axis='{}' armature='{}' {}/>",
                    Numbers(l.joints[k].p_PJ), Numbers(l.joints[k].R_PJ), Inertial(l.links[k]),
                    Numbers(l.joints[k].axis_J), motors.armature_kgm2[j], losses);
    if (options.ground != nullptr)
      open += Geoms(robot, core::BodyIndex(leg, static_cast<Joint>(j)));
    if (j == 2) open += fmt::format("<site name='{}' pos='{}'/>", LegName(leg), Numbers(l.p_LF));
    close += "</body>";
  }
  return open + close;
}

std::string Mjcf(const core::RobotDescription& robot, const MujocoOptions& options) {
  std::string legs, asset, ground;
  for (const Leg leg : kLegs) legs += LegXml(robot, leg, options);
  for (const sim::PayloadParams& p : options.payloads) legs += PayloadXml(p);
  if (options.sliding) legs += SlidingXml(*options.sliding);
  if (options.ground != nullptr) {
    const terrains::Heightfield& g = *options.ground;
    legs += Geoms(robot, 0);
    asset = fmt::format(
        "<asset><hfield name='ground' nrow='{0}' ncol='{0}' size='{1} {1} {2} 0.1'/></asset>",
        g.nodes(), g.half_size_m(), std::max(1e-3, g.max_m() - g.min_m()));
    ground = fmt::format(
        "<geom type='hfield' hfield='ground' pos='0 0 {}' friction='{}' contype='2' "
        "conaffinity='1'/>",
        g.min_m(), g.substrate().friction);
  }
  return fmt::format(
      "<mujoco><compiler angle='radian' eulerseq='XYZ' inertiafromgeom='auto' boundmass='0' "
      "boundinertia='0'/>"
      "<option gravity='0 0 -{}' timestep='{}' cone='elliptic'/>{}<worldbody>{}<body "
      "name='B'><freejoint/>{}{}</body></worldbody></mujoco>",
      options.gravity_mps2, options.step_s, asset, ground, Inertial(robot.trunk), legs);
}

void FillGround(const terrains::Heightfield& ground, mjModel& model) {
  const double range_m = std::max(1e-3, ground.max_m() - ground.min_m());
  for (std::size_t i = 0; i < ground.heights_m().size(); ++i) {
    model.hfield_data[i] = static_cast<float>((ground.heights_m()[i] - ground.min_m()) / range_m);
  }
}

}  // namespace

MujocoModel::MujocoModel(const core::RobotDescription& robot, const MujocoOptions& options) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "robot.xml").string(), xml = Mjcf(robot, options);
  std::FILE* file = std::fopen(path.c_str(), "w");
  std::fputs(xml.c_str(), file);
  std::fclose(file);
  char error[1000] = "";
  model.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
  if (!model) throw std::runtime_error(error);
  if (options.ground != nullptr) FillGround(*options.ground, *model);
  data.reset(mj_makeData(model.get()));
}

void MujocoModel::Set(const RobotState& s) {
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
  for (std::size_t j = 0; j < kNumJoints; ++j) {
    data->qpos[7 + j] = angles[j];
    data->qvel[6 + j] = rates[j];
  }
  mj_forward(model.get(), data.get());
}

void MujocoModel::SetTorques(const LegArray<Vec3>& tau_Nm) {
  const auto tau = Flatten(tau_Nm);
  std::copy(tau.begin(), tau.end(), data->qfrc_applied + 6);
}

RobotState MujocoModel::state() const {
  RobotState s;
  const mjtNum *q = data->qpos, *v = data->qvel;
  s.p_WB = {q[0], q[1], q[2]};
  s.R_WB = Quat(q[3], q[4], q[5], q[6]).toRotationMatrix();
  s.v_WB = {v[0], v[1], v[2]};
  s.w_WB = s.R_WB * Vec3(v[3], v[4], v[5]);
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const int i = kJointsPerLeg * static_cast<int>(leg) + j;
      s.q[leg][j] = q[7 + i];
      s.qd[leg][j] = v[6 + i];
    }
  }
  return s;
}

}  // namespace scoria::test
