// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/scenario.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/scenario/config_kinds.h"

namespace scoria::app {
namespace {

std::string NameOfSet(std::size_t change) {
  return fmt::format("controller_changes[{}].set", change);
}

}  // namespace

std::string Scenario::Problem() const {
  if (const auto* programme = std::get_if<VelocityProgramme>(&operation)) {
    const std::vector<VelocityStep>& steps = programme->steps;
    for (std::size_t i = 1; i < steps.size(); ++i) {
      if (steps[i].at_s < steps[i - 1].at_s)
        return fmt::format("operator.steps[{}].at_s: {} is before {}, that of the step above", i,
                           steps[i].at_s, steps[i - 1].at_s);
    }
  }
  for (std::size_t i = 1; i < controller_changes.size(); ++i) {
    if (controller_changes[i].at_s < controller_changes[i - 1].at_s)
      return fmt::format("controller_changes[{}].at_s: {} is before {}, that of the change above",
                         i, controller_changes[i].at_s, controller_changes[i - 1].at_s);
  }
  try {
    const std::vector<controller::ControllerParams> changed = ChangedControllers(*this);
    for (std::size_t i = 0; i < changed.size(); ++i) {
      if (changed[i].rates != controller.rates)
        return NameOfSet(i) + ": rates cannot change while walking";
    }
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return sim::PayloadProblem(payloads);
}

std::vector<controller::ControllerParams> ChangedControllers(const Scenario& scenario) {
  std::vector<controller::ControllerParams> changed;
  core::ConfigNode node = core::WriteConfig(scenario.controller);
  for (const ControllerChange& change : scenario.controller_changes) {
    try {
      for (const std::string& assignment : change.set)
        core::ApplyAssignment(node, assignment, {assignment, 0, 0, true});
      changed.push_back(core::ReadConfig<controller::ControllerParams>(node));
    } catch (const core::ConfigError& e) {
      throw core::ConfigError({}, NameOfSet(changed.size()), e.what());
    }
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
  return core::ReadConfig<Scenario>(LoadKind("scenario", file, overrides));
}

std::string EffectiveYaml(const Scenario& scenario) {
  return core::EmitYaml(core::WriteConfig(scenario));
}

}  // namespace scoria::app
