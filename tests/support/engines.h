// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "sim/plant/plant.h"

namespace scoria::test {

/// Tests that every engine has to pass: TEST_P over EngineTest.
class EngineTest : public ::testing::TestWithParam<sim::EngineParams> {
 protected:
  [[nodiscard]] sim::PhysicsParams Physics() const {
    sim::PhysicsParams params;
    params.engine = GetParam();
    return params;
  }
  [[nodiscard]] bool IsBullet() const {
    return std::holds_alternative<sim::BulletDynamics>(GetParam());
  }
};

inline auto AllEngines() {
  return ::testing::Values(sim::EngineParams(sim::ScoriaDynamics{}),
                           sim::EngineParams(sim::BulletDynamics{}));
}

inline std::string EngineOf(const ::testing::TestParamInfo<sim::EngineParams>& info) {
  return sim::EngineName(info.param);
}

}  // namespace scoria::test
