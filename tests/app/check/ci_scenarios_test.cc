// SPDX-License-Identifier: BSD-3-Clause
// scenarios/ci covers everything that a scenario can choose.
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/check/find_tests.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// What was seen, by kind.
class Coverage {
 public:
  void Add(const std::string& kind, const std::string& value) { seen_[kind].insert(value); }
  /// Expects all values of a kind.
  void Expect(const std::string& kind, const std::string& value) const {
    const auto found = seen_.find(kind);
    EXPECT_TRUE(found != seen_.end() && found->second.contains(value))
        << "no scenario of scenarios/ci has the " << kind << " " << value;
  }

 private:
  std::map<std::string, std::set<std::string>> seen_;
};

void AddController(const controller::ControllerParams& params, Coverage& seen) {
  const auto add_type = [&](const std::string& kind, const auto& variant) {
    seen.Add(kind, std::visit([](const auto& v) { return std::string(v.kType); }, variant));
  };
  add_type("gait", params.gait);
  add_type("body controller", params.wbc);
  add_type("estimator", params.estimator);
  add_type("adaptation", params.adaptation);
  seen.Add("contact source", std::string(core::EnumName(params.contact.source)));
  if (const auto* sgs = std::get_if<controller::SgsParams>(&params.gait))
    seen.Add("gait of the table", std::string(core::EnumName(sgs->gait)));
  if (const auto* tsid = std::get_if<controller::TsidParams>(&params.wbc))
    seen.Add("formulation", std::string(core::EnumName(tsid->formulation)));
}

void AddCiScenario(const Scenario& s, Coverage& seen) {
  seen.Add("terrain", s.terrain.name);
  seen.Add("robot", s.robot.name);
  AddController(s.controller, seen);
  for (const sim::SensorFault& fault : s.sensor_faults)
    seen.Add("sensor fault", std::string(core::EnumName(fault.kind)));
  for (const SolverOutage& outage : s.solver_faults.outages)
    seen.Add("solver fault",
             fmt::format("{} {}", core::EnumName(outage.solver), core::EnumName(outage.kind)));
  for (const sim::PayloadEvent& event : s.payloads) {
    seen.Add("payload action", std::string(core::EnumName(event.action)));
    if (event.body) seen.Add("payload", event.body->name);
  }
}

template <class... Ts>
void ExpectTypes(const Coverage& seen, const std::string& kind, const std::variant<Ts...>&) {
  (seen.Expect(kind, Ts::kType), ...);
}

template <class Enum>
void ExpectNames(const Coverage& seen, const std::string& kind) {
  for (const auto& [value, name] : EnumNames(Enum{})) seen.Expect(kind, std::string(name));
}

/// Every YAML file of a folder, by the name that it has in itself.
void ExpectFiles(const Coverage& seen, const std::string& kind, const std::string& folder) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::SourcePath(folder))) {
    const bool is_payload = entry.path().parent_path().filename() == "payloads";
    if (entry.path().extension() != ".yaml" || is_payload != (kind == "payload")) continue;
    seen.Expect(kind, core::LoadConfig(entry.path()).Find("name")->scalar);
    ++files;
  }
  EXPECT_GT(files, 2) << folder;
}

TEST(CiScenarios, CoverEveryChoice) {
  Coverage seen;
  for (const CheckTest& test : FindTests({{test::SourcePath("scenarios/ci")}, {}, {}}).tests) {
    ASSERT_FALSE(test.campaign) << test.name;
    AddCiScenario(test.jobs.front().scenario, seen);
  }
  ExpectFiles(seen, "terrain", "terrains");
  ExpectFiles(seen, "robot", "robots");
  ExpectFiles(seen, "payload", "robots");
  const controller::ControllerParams any;
  ExpectTypes(seen, "gait", any.gait);
  ExpectTypes(seen, "body controller", any.wbc);
  ExpectTypes(seen, "estimator", any.estimator);
  ExpectTypes(seen, "adaptation", any.adaptation);
  ExpectNames<controller::ContactChoice>(seen, "contact source");
  ExpectNames<controller::NamedGait>(seen, "gait of the table");
  ExpectNames<controller::TsidFormulation>(seen, "formulation");
  ExpectNames<sim::SensorFaultKind>(seen, "sensor fault");
  ExpectNames<sim::PayloadAction>(seen, "payload action");
  for (const auto& [solver, solver_name] : EnumNames(Solver{})) {
    for (const auto& [fault, fault_name] : controller::EnumNames(controller::SolverFault{}))
      seen.Expect("solver fault", fmt::format("{} {}", solver_name, fault_name));
  }
}

// A scenario that bounds nothing, or only what cannot go wrong, is no test.
TEST(CiScenarios, BoundFallsAndMore) {
  for (const CheckTest& test : FindTests({{test::SourcePath("scenarios/ci")}, {}, {}}).tests) {
    const Expectations& expect = test.jobs.front().scenario.expect;
    EXPECT_TRUE(expect.contains("falls")) << test.name;
    EXPECT_GE(expect.size(), 4u) << test.name;
  }
}

}  // namespace
}  // namespace scoria::app
