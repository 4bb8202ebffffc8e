// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/go1_log.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "core/robot_files/load.h"

namespace scoria::test {
namespace {

namespace fs = std::filesystem;

std::string ReadText(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

core::LegNames Go1Leg(const std::string& leg) {
  return {leg + "_hip_joint", leg + "_thigh_joint", leg + "_calf_joint", leg + "_foot"};
}

class CsvRow {
 public:
  explicit CsvRow(const std::string& line) {
    std::stringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) values_.push_back(std::stod(cell));
  }
  double Next() { return values_.at(next_++); }
  Vec3 NextVec3() {
    const double x = Next(), y = Next(), z = Next();
    return {x, y, z};
  }
  LegArray<Vec3> NextPerLeg() {
    const Vec3 fl = NextVec3(), fr = NextVec3(), hl = NextVec3(), hr = NextVec3();
    return {fl, fr, hl, hr};
  }

 private:
  std::vector<double> values_;
  std::size_t next_ = 0;
};

LogTick ReadTick(const std::string& line, const core::RobotDescription& robot) {
  CsvRow row(line);
  LogTick tick;
  row.Next();  // time: 1 kHz
  RobotState& s = tick.state;
  s.p_WB = row.NextVec3();
  const double x = row.Next(), y = row.Next(), z = row.Next(), w = row.Next();
  s.R_WB = Quat(w, x, y, z).normalized().toRotationMatrix();
  const LegArray<Vec3> q = row.NextPerLeg();
  s.v_WB = s.R_WB * row.NextVec3();  // the log's twist is in B
  s.w_WB = s.R_WB * row.NextVec3();
  const LegArray<Vec3> qd = row.NextPerLeg(), tau = row.NextPerLeg();
  tick.f_F_W = row.NextPerLeg();
  for (const Leg leg : kLegs) tick.contact[leg] = row.Next() > 0.5;
  tick.z.a_WS_S = row.NextVec3();
  tick.z.w_WS_S = row.NextVec3();
  for (const Leg leg : kLegs) {
    for (std::size_t j = 0; j < 3; ++j) {
      const core::JointDescription& joint = robot.legs[leg].joints[j];
      const auto k = static_cast<Eigen::Index>(j);
      s.q[leg][k] = (q[leg][k] - joint.urdf_zero_rad) / joint.urdf_sign;
      s.qd[leg][k] = qd[leg][k] / joint.urdf_sign;
      tick.z.tau_Nm[leg][k] = tau[leg][k] * joint.urdf_sign;
    }
  }
  tick.z.q = s.q;
  tick.z.qd = s.qd;
  return tick;
}

}  // namespace

std::optional<fs::path> Go1Folder() {
  const char* root = std::getenv("SCORIA_REFERENCE_DATA");
  if (root == nullptr) return std::nullopt;
  return fs::path(root) / "logs" / "go1_sim_trot_mpi";
}

core::RobotDescription LoadGo1(const fs::path& folder) {
  core::RobotConfig config;
  config.name = "go1";
  config.legs = {Go1Leg("FL"), Go1Leg("FR"), Go1Leg("RL"), Go1Leg("RR")};
  config.imu_link = "imu_link";
  // The log's simulator (Bullet) has no rotor inertia and leaves out the URDF's Coulomb friction;
  // it does apply the URDF's viscous damping of 0.01.
  config.motors.armature_kgm2 = Vec3::Zero();
  config.motors.friction_Nm = Vec3::Zero();
  config.motors.damping_Nms_per_rad = Vec3::Constant(0.01);
  return core::MakeRobot(config, ReadText(folder / "go1.urdf"));
}

std::vector<LogTick> ReadGo1Log(const fs::path& folder, const core::RobotDescription& robot) {
  std::ifstream file(folder / "go1_trot_1khz.csv");
  std::vector<LogTick> log;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) log.push_back(ReadTick(line, robot));
  return log;
}

}  // namespace scoria::test
