// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robots.h"

#include <cmath>
#include <cstdlib>

#include <unistd.h>

#include "controller/stand_up.h"
#include "core/config/archive.h"
#include "core/math/so3.h"
#include "core/robot_files/load.h"

namespace scoria::test {

namespace fs = std::filesystem;

fs::path SourcePath(const std::string& relative) { return fs::path(SCORIA_SOURCE_DIR) / relative; }

const core::RobotDescription& Go2() {
  static const core::RobotDescription kRobot = core::LoadRobot(
      core::ReadConfig<core::RobotConfig>(core::LoadConfig(SourcePath("robots/go2/go2.yaml"))));
  return kRobot;
}

terrains::Heightfield FlatGround(double friction, double size_m) {
  const double spacing_m = 0.1;
  const int n = static_cast<int>(std::lround(size_m / spacing_m));
  return terrains::Heightfield(
      n, spacing_m,
      std::vector<double>(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0),
      {.friction = friction});
}

terrains::Heightfield TiltedGround(double slope_rad, double friction) {
  constexpr int kNodes = 401;
  constexpr double kSpacing_m = 0.1;
  std::vector<double> heights;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column) {
      heights.push_back(std::tan(slope_rad) * (column - 200) * kSpacing_m);
    }
  }
  return terrains::Heightfield(kNodes, kSpacing_m, std::move(heights), {.friction = friction});
}

RobotState StandingState() {
  const core::RobotDescription& robot = Go2();
  RobotState state;
  state.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  state.p_WB.z() = robot.config.nominal_height_m + robot.legs[Leg::kFL].foot_radius_m;
  return state;
}

RobotState RandomState(core::Rng& rng) {
  const auto random = [&](double size) {
    return Vec3(rng.NextUniform(-size, size), rng.NextUniform(-size, size),
                rng.NextUniform(-size, size));
  };
  RobotState s;
  s.p_WB = random(2.0);
  s.R_WB = core::ExpSo3(random(1.0));
  s.v_WB = random(1.0);
  s.w_WB = random(2.0);
  for (const Leg leg : kLegs) {
    s.q[leg] = Vec3(0.0, 0.8, -1.6) + random(0.4);
    s.qd[leg] = random(4.0);
  }
  return s;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "scoria_test_XXXXXX").string();
  path_ = mkdtemp(pattern.data());
}

TemporaryFolder::~TemporaryFolder() { fs::remove_all(path_); }

}  // namespace scoria::test
