// SPDX-License-Identifier: BSD-3-Clause
// Faults, each put into logs that have none: walks of ours on level and rough ground, and
// recordings of two other simulators.
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/logs/quality/defects.h"
#include "tests/logs/quality/quality_logs.h"

namespace scoria::test {
namespace {

using logs::Finding;

constexpr int kPlaces = 10, kLeastNamed = 9;  // of walks of ours

/// Logs of one origin; places take them by turns.
using Group = std::vector<CleanLog>;

const std::vector<Group>& Groups() {
  static const std::vector<Group> kGroups = [] {
    std::vector<Group> groups = {
        {WalkOfGo2("flat", 1), WalkOfGo2("rough", 1), WalkOfGo2("flat", 2), WalkOfGo2("rough", 3)}};
    if (RecordedLog("")) {
      groups.push_back({Go1Log()});
      groups.push_back({MiniCheetahLog()});
    }
    return groups;
  }();
  return kGroups;
}

std::string Describe(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) text += "\n  " + DescribeFinding(f);
  return text;
}

/// Recordings of the simulators have no foot sensors, that of the Mini Cheetah has no IMU.
bool LacksSignal(const Defect& defect, const CleanLog& log) {
  if (defect.needs == Needed::kImu) return log.name == "minicheetah_raisim";
  return defect.needs == Needed::kFootForce &&
         (log.name == "minicheetah_raisim" || log.name == "go1_sim_trot_mpi");
}

class InjectedDefect : public testing::TestWithParam<Defect> {};

TEST_P(InjectedDefect, IsNamedInNineOfTenPlaces) {
  for (const Group& group : Groups()) {
    int named = 0, placed = 0;
    std::string missed;
    for (int place = 0; place < kPlaces; ++place) {
      const CleanLog& log = group[static_cast<std::size_t>(place) % group.size()];
      std::vector<logs::Row> rows = Window(log.rows, place);
      const std::optional<Expected> expected = GetParam().inject(rows, place);
      if (!expected) continue;  // the log has no such signal
      ++placed;
      const std::vector<Finding> findings = Judge(rows, log.robot.get());
      const bool is_named = std::any_of(findings.begin(), findings.end(),
                                        [&](const Finding& f) { return Names(f, *expected); });
      named += is_named ? 1 : 0;
      if (!is_named)
        missed += fmt::format("\n{}, place {}:{}", log.name, place, Describe(findings));
    }
    EXPECT_EQ(placed, LacksSignal(GetParam(), group.front()) ? 0 : kPlaces);
    const bool is_ours = &group == &Groups().front();
    const int least = is_ours ? kLeastNamed : GetParam().least_named;
    EXPECT_GE(named, placed > 0 ? least : 0) << group.front().name << missed;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, InjectedDefect, testing::ValuesIn(Defects()),
                         [](const auto& test_info) {
                           std::string name;
                           for (const char c : test_info.param.name)
                             name += std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

TEST(CleanLog, HasNoError) {
  for (const Group& group : Groups()) {
    for (const CleanLog& log : group) {
      for (const Finding& f : Judge(log.rows, log.robot.get()))
        EXPECT_NE(f.severity, logs::Severity::kError) << log.name << ": " << DescribeFinding(f);
    }
  }
}

/// Ground that is no level plane, and a gait with flight, where legs cannot be judged.
TEST(CleanLog, OfASlopeOrAGallopHasNoError) {
  for (const char* scenario : {"slope", "gallop", "vulcano"}) {
    const CleanLog log = WalkOfGo2(scenario, 7);
    for (const Finding& f : Judge(log.rows, log.robot.get()))
      EXPECT_NE(f.severity, logs::Severity::kError) << log.name << ": " << DescribeFinding(f);
  }
}

}  // namespace
}  // namespace scoria::test
