// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario.h"

#include <algorithm>

namespace scoria::app {

std::string Scenario::Problem() const {
  for (std::size_t i = 1; i < controller_changes.size(); ++i) {
    if (controller_changes[i].at_s < controller_changes[i - 1].at_s)
      return "controller_changes: at_s must not fall from one to the next";
  }
  try {
    for (const controller::ControllerParams& changed : ChangedControllers(*this)) {
      if (changed.rates != controller.rates)
        return "controller_changes: rates cannot change while walking";
    }
  } catch (const core::ConfigError& e) {
    return std::string("controller_changes: ") + e.what();
  }
  return sim::PayloadProblem(payloads);
}

std::vector<controller::ControllerParams> ChangedControllers(const Scenario& scenario) {
  std::vector<controller::ControllerParams> changed;
  core::ConfigNode node = core::WriteConfig(scenario.controller);
  for (const ControllerChange& change : scenario.controller_changes) {
    for (const std::string& assignment : change.set) core::ApplyOverride(node, assignment);
    changed.push_back(core::ReadConfig<controller::ControllerParams>(node));
  }
  return changed;
}

bool NeedsTruthEver(const Scenario& scenario) {
  const std::vector<controller::ControllerParams> changed = ChangedControllers(scenario);
  return controller::NeedsTruth(scenario.controller) ||
         std::any_of(changed.begin(), changed.end(),
                     [](const auto& params) { return controller::NeedsTruth(params); });
}

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
