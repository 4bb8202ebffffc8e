// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario.h"

namespace scoria::app {

Scenario LoadScenario(const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
  core::ConfigNode node = core::LoadConfig(file);
  for (const std::string& assignment : overrides) core::ApplyOverride(node, assignment);
  return core::ReadConfig<Scenario>(node);
}

std::string EffectiveYaml(const Scenario& scenario) {
  return core::EmitYaml(core::WriteConfig(scenario));
}

}  // namespace scoria::app
