// SPDX-License-Identifier: BSD-3-Clause
// Input: a robot's URDF.
#include <string>

#include "core/config/node.h"
#include "core/robot_files/load.h"
#include "tests/fuzz/fuzz.h"

namespace scoria::test {

void FuzzUrdf(std::span<const std::uint8_t> input) {
  const std::string text(input.begin(), input.end());
  if (text.find("<mesh") != std::string::npos) return;  // names files of this machine
  try {
    static_cast<void>(core::MakeRobot({}, text));
  } catch (const core::ConfigError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzUrdf)
