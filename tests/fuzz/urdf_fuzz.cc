// SPDX-License-Identifier: BSD-3-Clause
// Input: the URDF of a robot whose legs have the Go2's names.
#include <string>

#include "core/config/node.h"
#include "core/robot_files/load.h"
#include "tests/fuzz/fuzz.h"

namespace scoria::test {

namespace {

core::LegNames LegOf(const std::string& leg) {
  return {leg + "_hip_joint", leg + "_thigh_joint", leg + "_calf_joint", leg + "_foot"};
}

}  // namespace

void FuzzUrdf(std::span<const std::uint8_t> input) {
  const std::string text(input.begin(), input.end());
  if (text.find("<mesh") != std::string::npos) return;  // names files of this machine
  core::RobotConfig config;
  config.legs = {LegOf("FL"), LegOf("FR"), LegOf("RL"), LegOf("RR")};  // as in the corpus
  try {
    static_cast<void>(core::MakeRobot(config, text));
  } catch (const core::ConfigError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzUrdf)
