// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario.h"

#include <gtest/gtest.h>

#include "app/campaign.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

std::string ErrorOf(const std::vector<std::string>& overrides) {
  try {
    (void)test::LoadScenario("flat", overrides);
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Scenario, EveryFileOfTheRepositoryLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::SourcePath("scenarios"))) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW((void)LoadScenario(entry.path(), {})) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
  for (const auto& entry : std::filesystem::directory_iterator(test::SourcePath("campaigns"))) {
    EXPECT_NO_THROW((void)LoadCampaign(entry.path(), {})) << entry.path();
  }
}

TEST(Scenario, EffectiveYamlReadsBackToItself) {
  const Scenario scenario = test::LoadScenario("vulcano");
  const std::string yaml = EffectiveYaml(scenario);
  const auto again = core::ReadConfig<Scenario>(core::ParseConfig(yaml, "effective.yaml"));
  EXPECT_EQ(EffectiveYaml(again), yaml);
}

TEST(Scenario, ErrorsNameTheOverrideAndTheRule) {
  EXPECT_EQ(ErrorOf({"controller.mpc.horizon=40"}),
            "--set controller.mpc.horizon=40: controller.mpc.horizon: 40 is outside [2, 20]");
  EXPECT_EQ(ErrorOf({"controller.gait.type=trot"}),
            "--set controller.gait.type=trot: controller.gait.type: unknown \"trot\"; choices: "
            "ags, sgs, sgs_matched");
  EXPECT_EQ(ErrorOf({"controler.gait=3"}),
            "--set controler.gait=3: controler: unknown key (did you mean \"controller\"?)");
}

}  // namespace
}  // namespace scoria::app
