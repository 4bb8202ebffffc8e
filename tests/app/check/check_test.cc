// SPDX-License-Identifier: BSD-3-Clause
// Scenarios and campaigns as tests, by the command as users have it.
#include <sstream>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/check/find_tests.h"
#include "app/check/judge.h"
#include "app/cli/exit_codes.h"
#include "app/gate/run_program.h"
#include "core/files.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A folder with scenarios of one second on level ground, by name and what they expect.
void AddScenario(const fs::path& folder, const std::string& name, const std::string& expect,
                 const std::string& more = "") {
  core::CreateFolders((folder / name).parent_path());
  core::WriteText(folder / (name + ".yaml"),
                  fmt::format("name: {}\nbase: {}\nstart: standing\nduration_s: 1\n"
                              "terrain: {{size_m: 6.4, resolution_m: 0.1}}\n{}expect: {}\n",
                              fs::path(name).filename().string(),
                              test::SourcePath("scenarios/flat.yaml").string(), more, expect));
}

struct Checked {
  test::ProgramEnd end;
  json outcomes;  // by --json
};

Checked Check(const fs::path& folder, std::vector<std::string> more = {}) {
  const fs::path out = folder.parent_path() / "out";
  std::vector<std::string> arguments = {"check",  folder.string(),
                                        "--out",  out.string(),
                                        "--json", (folder.parent_path() / "o.json").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Checked checked{test::RunScoria(arguments, {.folder = {}, .largest_file = 0, .patience_s = 300}),
                  {}};
  checked.outcomes = json::parse(core::ReadText(folder.parent_path() / "o.json"), nullptr, false);
  return checked;
}

TEST(Check, PassesWhatKeepsItsBounds) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "a", "{falls: 0, events.fall: 0, supervisor.mpc: [0, 0]}");
  AddScenario(folder, "below/b", "{duration_s: {min: 0.9, max: 1}}");
  core::WriteText(folder / "gait.yaml", "gait: {type: sgs}\n");
  const Checked checked = Check(folder);
  EXPECT_EQ(checked.end.code, kOk) << checked.end.output;
  EXPECT_NE(checked.end.output.find("2 passed, 0 failed, 0 in error"), std::string::npos);
  EXPECT_NE(checked.end.output.find("gait.yaml is a controller, no test"), std::string::npos);
  ASSERT_EQ(checked.outcomes["tests"].size(), 2u);
  EXPECT_EQ(checked.outcomes["tests"][1]["name"], "below/b");
  EXPECT_EQ(checked.outcomes["tests"][0]["bounds"].size(), 3u);
}

TEST(Check, FailsBrokenBoundsAndWhatDoesNotApply) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "broken", "{duration_s: {min: 2}, falls: 0}");
  AddScenario(folder, "not_there", "{model_bias_median_kg: {max: 1}}");
  AddScenario(folder, "sound", "{falls: 0}");
  const fs::path junit = temporary.path() / "j.xml";
  const Checked checked = Check(folder, {"--no-artifacts", "--junit", junit.string()});
  EXPECT_EQ(checked.end.code, kFailed) << checked.end.output;
  EXPECT_NE(checked.end.output.find("duration_s is 0.998, must be at least 2"), std::string::npos)
      << checked.end.output;
  EXPECT_NE(checked.end.output.find("model_bias_median_kg does not apply"), std::string::npos);
  EXPECT_NE(checked.end.output.find("1 passed, 2 failed"), std::string::npos);

  boost::property_tree::ptree tree;  // a parser that is not ours
  boost::property_tree::read_xml(junit.string(), tree);
  const auto& suite = tree.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<int>("<xmlattr>.tests"), 3);
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 2);
  EXPECT_EQ(suite.count("testcase"), 3u);
  int failures = 0;
  for (const auto& [tag, child] : suite) {
    if (tag == "testcase") failures += static_cast<int>(child.count("failure"));
  }
  EXPECT_EQ(failures, 2);
}

/// What the reader of JUnit files of Debian's python3-junitparser counts: cases, failures, errors,
/// and the problems of those that failed. The first line is "absent" where it is not installed.
std::vector<std::string> ReadByJunitparser(const fs::path& junit) {
  const fs::path script = junit.parent_path() / "read.py";
  core::WriteText(script,
                  "import sys\n"
                  "try:\n"
                  "    from junitparser import JUnitXml, Failure, Error\n"
                  "except ImportError:\n"
                  "    print('absent'); sys.exit()\n"
                  "xml = JUnitXml.fromfile(sys.argv[1])\n"
                  "cases = [case for suite in xml for case in suite]\n"
                  "results = [r for case in cases for r in case.result]\n"
                  "of = lambda kind: [r for r in results if isinstance(r, kind)]\n"
                  "print(len(cases), len(of(Failure)), len(of(Error)))\n"
                  "print(xml.tests, xml.failures, xml.errors)\n"
                  "for case in cases: print(case.classname + '/' + case.name)\n"
                  "for r in of(Failure): print(r.message)\n");
  const fs::path out = junit.parent_path() / "read.txt";
  const int code = RunProgram({"/usr/bin/python3", script.string(), junit.string()}, out);
  if (code == 127) return {"absent"};
  EXPECT_EQ(code, 0) << core::ReadText(out);
  std::istringstream in(core::ReadText(out));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Check, ItsJunitIsAcceptedByAnIndependentParser) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests", junit = temporary.path() / "j.xml";
  AddScenario(folder, "below/broken", "{duration_s: {min: 2}, falls: 0}");
  AddScenario(folder, "sound", "{falls: 0}");
  (void)Check(folder, {"--no-artifacts", "--junit", junit.string()});
  const std::vector<std::string> read = ReadByJunitparser(junit);
  ASSERT_FALSE(read.empty());
  if (read[0] == "absent") GTEST_SKIP() << "python3-junitparser is not installed";
  ASSERT_EQ(read.size(), 5u);
  EXPECT_EQ(read[0], "2 1 0");
  EXPECT_EQ(read[1], "2 1 0") << "by the attributes of the file";
  EXPECT_EQ(read[4], "duration_s is 0.998, must be at least 2");
}

TEST(Check, ShowsAFailureByLogClipAndFigure) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "broken", "{duration_s: {min: 2}}");
  const Checked checked = Check(folder);
  EXPECT_EQ(checked.end.code, kFailed);
  const json& test = checked.outcomes["tests"][0];
  EXPECT_EQ(test["artifact_problem"], "");
  ASSERT_EQ(test["artifacts"].size(), 3u) << test;
  for (const json& file : test["artifacts"])
    EXPECT_GT(fs::file_size(file.get<std::string>()), 1000u) << file;
  const auto hash = [&](const fs::path& run) {
    return json::parse(core::ReadText(run / "result.json"))["state_hash"];
  };
  const fs::path run = temporary.path() / "out" / "broken";
  EXPECT_EQ(hash(run), hash(run / "failure")) << "the log shows the walk that failed";
}

TEST(Check, OverridesReachTheTestsThatHaveTheKey) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "tsid", "{falls: 0}");
  AddScenario(folder, "inverse", "{falls: 0}", "controller: {wbc: {type: inverse_dynamics}}\n");
  const auto find = [&](const std::string& set) { return FindTests({{folder}, {set}, {}}).tests; };
  const std::vector<CheckTest> tests = find("controller.wbc.friction=0.8");
  ASSERT_EQ(tests.size(), 2u);
  EXPECT_EQ(tests[0].name, "inverse");
  EXPECT_EQ(tests[0].unfit.size(), 1u);
  EXPECT_TRUE(tests[1].unfit.empty());
  EXPECT_EQ(std::get<controller::TsidParams>(tests[1].jobs[0].scenario.controller.wbc).friction,
            0.8);
  try {
    (void)find("controller.wbc.frictoin=0.8");
    ADD_FAILURE() << "a key that no test has";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("frictoin"), std::string::npos) << e.what();
  }
}

TEST(Check, ShardsAreAPartitionOfTheTests) {
  const test::TemporaryFolder temporary;
  for (const char* name : {"a", "b", "c", "d", "e"}) AddScenario(temporary.path(), name, "{}");
  std::multiset<std::string> names;
  for (int part = 1; part <= 3; ++part) {
    for (const CheckTest& test : FindTests({{temporary.path()}, {}, {part, 3}}).tests)
      names.insert(test.name);
  }
  EXPECT_EQ(names, (std::multiset<std::string>{"a", "b", "c", "d", "e"}));
  EXPECT_EQ(test::RunScoria({"check", temporary.path().string(), "--shard", "4/3"}).code,
            kBadInput);
}

TEST(Check, WrongFilesAreRefusedBeforeAnyWalk) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "a", "{falls: 0}");
  AddScenario(folder, "b", "{fals: 0}");
  const Checked checked = Check(folder);
  EXPECT_EQ(checked.end.code, kBadInput);
  EXPECT_NE(checked.end.output.find("b.yaml:6:10: expect.fals: unknown key (did you mean "
                                    "\"falls\"?)"),
            std::string::npos)
      << checked.end.output;
  EXPECT_FALSE(fs::exists(temporary.path() / "out"));
  core::CreateFolders(temporary.path() / "empty");
  EXPECT_EQ(Check(temporary.path() / "empty").end.code, kBadInput);
}

TEST(Check, AnEpisodeThatIsNoWalkIsAnError) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "tests";
  AddScenario(folder, "still", "{falls: {min: 0}}", "controller: {stand_up: {duration_s: 20}}\n");
  std::string text = core::ReadText(folder / "still.yaml");
  const std::string times = "start: standing\nduration_s: 1\n";
  text.replace(text.find(times), times.size(), "start: lying\nduration_s: 6\n");
  core::WriteText(folder / "still.yaml", text);
  const Checked checked = Check(folder, {"--no-artifacts"});
  EXPECT_EQ(checked.end.code, kFailed);
  EXPECT_NE(checked.end.output.find("0 passed, 0 failed, 1 in error"), std::string::npos)
      << checked.end.output;
}

}  // namespace
}  // namespace scoria::app
