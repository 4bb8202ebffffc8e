// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/robot_warnings.h"

#include <gtest/gtest.h>

#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

std::vector<std::string> Warnings(const std::string& at, const std::string& adaptation) {
  return TareWarnings(test::LoadScenario(
      "flat", {"controller.adaptation=" + adaptation,
               "payloads=[{" + at + ", action: add, body: {name: box, mass_kg: 3}}]"}));
}

TEST(TareWarnings, PayloadWithinTheTareIsToldOf) {
  EXPECT_EQ(Warnings("at_s: 4", "{type: kf_plus, start_s: 2, tare: {duration_s: 10}}"),
            std::vector<std::string>{
                "payloads[0].at_s: 4 s is within the first 12 s of walking, in which the robot is "
                "tared (controller.adaptation.start_s and tare.duration_s): part of 3 kg will "
                "count as the robot's own for good"});
}

TEST(TareWarnings, NoneAfterItNorWithoutIt) {
  EXPECT_TRUE(Warnings("at_s: 12", "{type: kf_plus, start_s: 2, tare: {duration_s: 10}}").empty());
  EXPECT_TRUE(Warnings("distance_m: 1", "{type: kf_plus}").empty());
  EXPECT_TRUE(Warnings("at_s: 4", "{type: kf_plus, tare: {enabled: false}}").empty());
  EXPECT_TRUE(Warnings("at_s: 4", "{type: none}").empty());
}

}  // namespace
}  // namespace scoria::app
