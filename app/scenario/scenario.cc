// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/scenario.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/scenario/config_kinds.h"
#include "core/rate.h"
#include "core/robot_files/load.h"

namespace scoria::app {
namespace {

std::string NameOfSet(std::size_t change) {
  return fmt::format("controller_changes[{}].set", change);
}

/// Rates that the scenario asks for, by key.
using Rates = std::vector<std::pair<std::string, double>>;

Rates RatesOf(const Scenario& scenario) {
  const controller::ControllerParams& controller = scenario.controller;
  Rates rates = {{"controller.rates.wbc_Hz", controller.rates.wbc_Hz},
                 {"controller.rates.mpc_Hz", controller.rates.mpc_Hz}};
  std::visit(
      [&](const auto& adaptation) {
        if constexpr (requires { adaptation.rate_Hz; })
          rates.emplace_back("controller.adaptation.rate_Hz", adaptation.rate_Hz);
      },
      controller.adaptation);
  if (const auto* sensors = std::get_if<sim::RealisticSensors>(&scenario.sensors)) {
    const auto add = [&](const char* sensor, const sim::SamplingParams& sampling) {
      // A rate above that of the physics is one sample in every step.
      if (sampling.rate_Hz * scenario.physics.step_s < 1.0)
        rates.emplace_back(fmt::format("sensors.{}.sampling.rate_Hz", sensor), sampling.rate_Hz);
    };
    add("imu", sensors->imu.sampling);
    add("encoders", sensors->encoders.sampling);
    add("torque", sensors->torque.sampling);
    add("foot_force", sensors->foot_force.sampling);
  }
  return rates;
}

}  // namespace

std::string Scenario::Problem() const {
  for (const auto& [key, rate_Hz] : RatesOf(*this)) {
    if (const std::string problem = core::RateProblem(rate_Hz, physics.step_s); !problem.empty())
      return fmt::format("{}: {}", key, problem);
  }
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
  if (std::string problem = sim::EngineProblem(physics, sliding_payload.has_value());
      !problem.empty())
    return problem;
  return sim::PayloadProblem(payloads);
}

std::vector<controller::ControllerParams> ChangedControllers(const Scenario& scenario) {
  std::vector<controller::ControllerParams> changed;
  core::ConfigNode node = core::WriteConfig(scenario.controller);
  for (const ControllerChange& change : scenario.controller_changes) {
    try {
      for (const std::string& assignment : change.set)
        core::ApplyAssignment(node, assignment, {assignment, 0, 0, true});
      core::ConfigContext context{.similarity = scenario.similarity, .notes = {}};
      changed.push_back(core::ReadConfig<controller::ControllerParams>(node, context));
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

core::RobotConfig ReadRobotSection(const core::ConfigNode& scenario) {
  core::RobotConfig config;
  core::ConfigContext context;
  const core::ConfigNode* robot = scenario.Find("robot");
  if (robot == nullptr)
    throw core::ConfigError(scenario.origin, "robot", "is missing and has no default");
  core::ConfigReader::Read(*robot, "robot", context, config);
  return config;
}

core::RobotDescription ReadScaledRobot(const core::ConfigNode& robot) {
  const auto own_size = core::ReadConfig<core::RobotConfig>(robot);
  core::ConfigContext context{.similarity = core::ReadRobot(own_size).similarity, .notes = {}};
  return core::ReadRobot(core::ReadConfig<core::RobotConfig>(robot, context));
}

Scenario ReadScenario(const core::ConfigNode& node, const core::Similarity& similarity) {
  core::ConfigContext context{.similarity = similarity, .notes = {}};
  Scenario scenario;
  scenario.similarity = similarity;
  core::ConfigReader::Read(node, "", context, scenario);
  CheckExpectedNames(node);
  scenario.notes = std::move(context.notes);
  return scenario;
}

Scenario ReadScenario(const core::ConfigNode& node) {
  return ReadScenario(node, core::ReadRobot(ReadRobotSection(node)).similarity);
}

Scenario LoadScenario(const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
  return ReadScenario(LoadKind("scenario", file, overrides));
}

std::string EffectiveYaml(const Scenario& scenario) {
  return core::EmitYaml(core::WriteConfig(scenario));
}

}  // namespace scoria::app
