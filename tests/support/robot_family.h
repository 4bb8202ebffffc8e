// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scoria::test {

/// A relative of the Go2. By masses and lengths alone it is dynamically similar to it: inertias go
/// with m l², torques and friction with m l, joint speeds with l^-1/2, damping with m l^3/2.
struct FamilyMember {
  std::string name = "plain";
  double mass_scale = 1.0, length_scale = 1.0;
  std::optional<double> leg_mass_share =
      std::nullopt;                 // of the robot, without an arm; absent: the Go2's 54 %
  bool mirrored_hind_legs = false;  // images of the front legs; knees that may bend either way
  bool turned_frames =
      false;               // joint axes are z of their frames, with signs and zeros of their own
  bool root_away = false;  // the root is a massless link on the ground, turned by 90 degrees
  bool unscaled_motors = false;
  bool arm = false;  // of three joints on the back, a tenth of the robot's mass
};

/// The plain robot and the eleven others of the acceptance test of robots by file.
[[nodiscard]] std::vector<FamilyMember> RobotFamily();

[[nodiscard]] std::string FamilyUrdf(const FamilyMember& member);

/// Writes NAME.urdf and NAME.yaml, without any key that has a default derived from the robot.
/// @returns the YAML's path.
std::filesystem::path WriteFamilyRobot(const FamilyMember& member,
                                       const std::filesystem::path& folder);

}  // namespace scoria::test
