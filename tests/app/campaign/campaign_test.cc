// SPDX-License-Identifier: BSD-3-Clause
// Campaigns under what a computer does to them: full disks, dead processes, broken and changed
// files. With SCORIA_LONG_TESTS=1 they are as large as a night's work.
#include "app/campaign/campaign.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mount.h>

#include "analysis/report/report.h"
#include "core/files.h"
#include "core/rng.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using Again = std::map<std::string, int>;

bool IsLong() { return std::getenv("SCORIA_LONG_TESTS") != nullptr; }

/// Two arms of short walks on level ground, one of them with a difficult name.
fs::path WriteCampaign(const fs::path& folder, int seeds,
                       const std::string& scenario = "  duration_s: 1\n") {
  const fs::path file = folder / "c.yaml";
  core::WriteText(file,
                  fmt::format("name: small\nseeds: {}\nscenario:\n  base: {}\n"
                              "  terrain: {{size_m: 6.4, resolution_m: 0.1}}\n"
                              "{}"
                              "arms:\n  - {{name: ags}}\n"
                              "  - name: '50 % \"x\"\\y'\n"
                              "    set: {{controller: {{gait: {{type: sgs}}}}}}\n",
                              seeds, test::SourcePath("scenarios/flat.yaml").string(), scenario));
  return file;
}

CampaignOutcome Walk(const fs::path& file, const fs::path& folder, Again* again = nullptr) {
  CampaignOptions options;
  options.program = SCORIA_PROGRAM;
  options.folder = folder;
  if (again != nullptr)
    options.on_again = [again](const std::string& reason, int n) { (*again)[reason] = n; };
  return RunCampaign(LoadCampaign(file, {}), options);
}

/// Lines of a campaign's metrics.csv without the columns that a clock on the wall fills.
std::vector<std::string> Table(const fs::path& folder) {
  const fs::path page = analysis::WriteReport(folder);
  std::istringstream csv(core::ReadText(page.parent_path() / "metrics.csv"));
  std::vector<std::string> lines;
  std::vector<bool> clock;
  for (std::string line; std::getline(csv, line);) {
    std::string kept, field;
    std::istringstream fields(line);
    for (std::size_t i = 0; std::getline(fields, field, ','); ++i) {
      if (lines.empty())
        clock.push_back(field.starts_with("mpc_") || field.starts_with("wbc_") ||
                        field == "real_time_factor");
      if (!clock.at(i)) kept += field + ",";
    }
    lines.push_back(kept);
  }
  return lines;
}

std::vector<std::string> Command(const fs::path& file, const fs::path& folder) {
  return {"campaign", file.string(), "--workers", "2", "--out", folder.string()};
}

/// Waits until a campaign has a worker, or ends. @returns one of its workers, 0 for none.
pid_t AnyWorker(pid_t campaign) {
  for (int i = 0; i < 500; ++i) {
    const std::vector<pid_t> workers = test::ChildrenOf(campaign);
    if (!workers.empty()) return workers.back();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

TEST(Campaign, ChangedFilesAreWalkedAgainAndNamed) {
  const test::TemporaryFolder folder;
  const fs::path robot = folder.path() / "mule", out = folder.path() / "out",
                 ground = folder.path() / "g.asc";
  fs::copy(test::SourcePath("tests/data/robots/mule"), robot, fs::copy_options::recursive);
  const auto write_ground = [&](double height_m) {
    std::string text = "ncols 32\nnrows 32\nxllcorner 0\nyllcorner 0\ncellsize 0.25\n";
    for (int row = 0; row < 32; ++row) {
      for (int column = 0; column < 32; ++column) text += fmt::format("{} ", height_m);
      text += "\n";
    }
    core::WriteText(ground, text);
  };
  write_ground(0.0);
  const fs::path file = folder.path() / "c.yaml";
  core::WriteText(file, fmt::format("name: small\nseeds: 1\nscenario:\n  base: {}\n"
                                    "  robot: {{base: mule/mule.yaml}}\n"
                                    "  terrain: {{heightmap: {{file: g.asc}}}}\n"
                                    "  duration_s: 0.2\narms: [{{name: a}}]\n",
                                    test::SourcePath("scenarios/flat.yaml").string()));
  EXPECT_EQ(Walk(file, out).crashed, 0);
  EXPECT_EQ(Walk(file, out).done_before, 1);

  const auto expect_again = [&](const std::string& reason) {
    Again again;
    const CampaignOutcome outcome = Walk(file, out, &again);
    EXPECT_EQ(outcome.done_before, 0);
    EXPECT_EQ(outcome.crashed, 0);
    EXPECT_EQ(again, (Again{{reason, 1}}));
    EXPECT_EQ(Walk(file, out).done_before, 1) << "and then it stands";
  };
  write_ground(0.5);
  expect_again(ground.string() + " has changed");
  std::ofstream(robot / "mule.urdf", std::ios::app) << "<!-- -->\n";
  expect_again((robot / "mule.urdf").string() + " has changed");
  std::fstream(robot / "meshes/trunk.stl", std::ios::in | std::ios::out) << "c";  // in its comment
  expect_again((robot / "meshes/trunk.stl").string() + " has changed");
  std::ofstream(robot / "mule.yaml", std::ios::app) << "motors: {idle_W: 40}\n";
  expect_again("the scenario has changed");
}

TEST(Campaign, BrokenAndInterruptedResultsAreWalkedAgain) {
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), 2), out = folder.path() / "out";
  EXPECT_EQ(Walk(file, out).unfinished, 0);
  const fs::path result = out / "episodes/ags-s1/result.json";
  nlohmann::json json = nlohmann::json::parse(core::ReadText(result));
  for (const char* broken :
       {"", "{", "[1, 2]", R"({"end": 4})", R"({"end": "completed", "falls": "x"})"}) {
    core::WriteText(result, broken);
    Again again;
    EXPECT_EQ(Walk(file, out, &again).done_before, 3);
    EXPECT_EQ(again, (Again{{"the result cannot be read", 1}})) << broken;
  }
  json["end"] = "interrupted";
  core::WriteText(result, json.dump());
  Again again;
  EXPECT_EQ(Walk(file, out, &again).done_before, 3);
  EXPECT_EQ(again, (Again{{"interrupted", 1}}));
  json["end"] = "completed";
  json["version"] = "0.0.1";
  core::WriteText(result, json.dump());
  EXPECT_EQ(Walk(file, out, &again).done_before, 3);
  EXPECT_TRUE(again.contains("walked by another version of scoria"));
}

/// A program in the place of scoria.
fs::path WriteProgram(const fs::path& folder, const std::string& script) {
  const fs::path program = folder / "program.sh";
  core::WriteText(program, "#!/bin/sh\n" + script + "\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

TEST(Campaign, OwnFaultsAreCrashesAndOutsideOnesAreWalkedAgain) {
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), 1), out = folder.path() / "out";
  struct Case {
    const char* script;
    int crashed, unfinished;
  };
  // With --out FOLDER as the fourth argument.
  for (const auto& [script, crashed, unfinished] :
       {Case{"kill -SEGV $$", 2, 0}, Case{"kill -ABRT $$", 2, 0}, Case{"exit 2", 2, 0},
        Case{"exit 1", 2, 0}, Case{"kill -KILL $$", 0, 2}, Case{"kill -TERM $$", 0, 2},
        Case{"exit 3", 0, 2}, Case{"exit 0", 0, 2}, Case{": > $4/result.json", 0, 2},
        Case{"echo '{\"end\": \"comp' > $4/result.json; exit 1", 0, 2}}) {
    fs::remove_all(out);
    CampaignOptions options;
    options.program = WriteProgram(folder.path(), script).string();
    options.folder = out;
    const CampaignOutcome outcome = RunCampaign(LoadCampaign(file, {}), options);
    EXPECT_EQ(outcome.crashed, crashed) << script;
    EXPECT_EQ(outcome.unfinished, unfinished) << script;
    EXPECT_EQ(Walk(file, out).done_before, crashed) << script;
  }
}

/// Two arms, of which the heavy one stands lower on every seed, and when that ends the campaign.
fs::path WriteStoppingCampaign(const fs::path& folder, const std::string& stop) {
  const fs::path file = folder / "c.yaml";
  core::WriteText(file, fmt::format("name: small\nseeds: 12\nscenario:\n  base: {}\n"
                                    "  start: standing\n  duration_s: 5\n"
                                    "  terrain: {{size_m: 6.4, resolution_m: 0.1}}\n"
                                    "  log: {{keep: metrics}}\narms:\n  - {{name: ags}}\n"
                                    "  - {{name: heavy, set: {{controller: {{model: "
                                    "{{mass_offset_kg: 4}}}}}}}}\nstop: {}\n",
                                    test::SourcePath("scenarios/flat.yaml").string(), stop));
  return file;
}

TEST(Campaign, StopsByItselfOnceDecidedForAnyNumberOfWorkers) {
  const test::TemporaryFolder folder;
  const fs::path file =
      WriteStoppingCampaign(folder.path(), "{when_decided: height_rmse_m, alpha: 0.2}");
  const fs::path out = folder.path() / "out", other = folder.path() / "other";
  const test::ProgramEnd end = test::RunScoria(Command(file, out));
  EXPECT_EQ(end.code, 0) << end.output;
  EXPECT_NE(end.output.find("Stopped by itself after seed "), std::string::npos) << end.output;
  const auto index = nlohmann::json::parse(core::ReadText(out / "campaign.json"));
  const auto last_seed = index.at("stop").at("last_seed").get<int>();
  EXPECT_LT(last_seed, 12);
  EXPECT_EQ(index.at("episodes").size(), 2 * last_seed);
  const std::string html = core::ReadText(analysis::WriteReport(out));
  EXPECT_NE(html.find("Stopped by itself after seed "), std::string::npos);

  const CampaignOutcome again = Walk(file, out);
  EXPECT_EQ(again.episodes, 2 * last_seed);
  EXPECT_EQ(again.done_before, 2 * last_seed) << "nothing is left to walk";
  EXPECT_EQ(core::ReadText(out / "campaign.json"), index.dump(2) + "\n");

  CampaignOptions one;
  one.program = SCORIA_PROGRAM;
  one.folder = other;
  one.workers = 1;
  EXPECT_EQ(RunCampaign(LoadCampaign(file, {}), one).episodes, 2 * last_seed);
}

TEST(Campaign, AStopRuleNeedsTwoArmsAndSomethingThatThereIs) {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& rule) -> std::string {
    try {
      (void)LoadCampaign(WriteStoppingCampaign(folder.path(), rule), {});
    } catch (const core::ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("{when_decided: fals}")
                .find("stop.when_decided: fals: is neither falls nor a metric (did you mean "
                      "\"falls\"?)"),
            std::string::npos);
  EXPECT_NE(message("{alpha: 0.7}").find("stop.alpha: 0.7 is outside"), std::string::npos);
}

TEST(Campaign, CrashStandsUntilItsInputsChange) {
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), 1), out = folder.path() / "out";
  CampaignOptions options;
  options.program = WriteProgram(folder.path(), "echo the reason >&2; kill -SEGV $$").string();
  options.folder = out;
  const Campaign campaign = LoadCampaign(file, {});
  EXPECT_EQ(RunCampaign(campaign, options).crashed, 2);
  const auto result = nlohmann::json::parse(core::ReadText(out / "episodes/ags-s1/result.json"));
  EXPECT_EQ(result.at("end"), "crashed");
  EXPECT_EQ(result.at("message"), "signal 11: the reason");
  EXPECT_EQ(RunCampaign(campaign, options).done_before, 2);
}

TEST(Campaign, NotWalkingIsAnOutcome) {
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(
      folder.path(), 1,
      "  duration_s: 8\n  start: standing\n  robot: {motors: {friction_Nm: [10, 10, 10]}}\n");
  const CampaignOutcome outcome = Walk(file, folder.path() / "out");
  EXPECT_EQ(outcome.failed, 2);
  EXPECT_EQ(outcome.crashed, 0);
  const std::string html = core::ReadText(analysis::WriteReport(folder.path() / "out"));
  EXPECT_NE(html.find(" m were commanded</td>"), std::string::npos);
}

TEST(Campaign, SecondAtATimeIsRefused) {
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), 20), out = folder.path() / "out";
  const pid_t first = test::StartScoria(Command(file, out));
  EXPECT_NE(AnyWorker(first), 0);
  const test::ProgramEnd second = test::RunScoria(Command(file, out));
  EXPECT_EQ(second.code, 2);
  EXPECT_EQ(second.output, out.string() + ": another process is writing to this folder\n");
  kill(first, SIGTERM);
  EXPECT_EQ(test::WaitFor(first), 3);
}

/// kill -9 of workers and of the campaign itself, at random moments.
TEST(Campaign, SurvivesKills) {
  const int seeds = IsLong() ? 100 : 6, kills = IsLong() ? 60 : 6;
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), seeds), out = folder.path() / "out";
  core::Rng rng(14, 0, core::Stream::kSensor);
  for (int k = 0; k < kills; ++k) {
    const pid_t campaign = test::StartScoria(Command(file, out));
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + rng.NextU32() % 400));
    const pid_t worker = AnyWorker(campaign);
    if (worker != 0) kill(worker, SIGKILL);
    const bool parent_too = k + 1 < kills;  // the last campaign goes on without its worker
    if (parent_too) kill(campaign, SIGKILL);
    const int code = test::WaitFor(campaign);
    EXPECT_TRUE(code == -SIGKILL || code == 3 || code == 0) << code;
  }
  EXPECT_EQ(test::RunScoria(Command(file, out)).code, 0);
  EXPECT_EQ(Walk(file, folder.path() / "undisturbed").unfinished, 0);
  EXPECT_EQ(Table(out), Table(folder.path() / "undisturbed"));
}

/// A disk of a given size, for root only.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& at, int megabytes) : at_(at) {
    fs::create_directories(at);
    mounted_ = mount("tmpfs", at.c_str(), "tmpfs", 0, Size(megabytes).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(at_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }
  void Grow(int megabytes) const {
    ASSERT_EQ(mount("tmpfs", at_.c_str(), "tmpfs", MS_REMOUNT, Size(megabytes).c_str()), 0);
  }

 private:
  static std::string Size(int megabytes) { return fmt::format("size={}m", megabytes); }
  fs::path at_;
  bool mounted_ = false;
};

TEST(Campaign, SurvivesAFullDiskKillsAndABrokenResult) {
  const int seeds = IsLong() ? 30 : 4;
  const test::TemporaryFolder folder;
  const fs::path file = WriteCampaign(folder.path(), seeds), out = folder.path() / "disk" / "out";
  const SmallDisk disk(folder.path() / "disk", seeds);  // an episode's log takes about 1 MB
  if (!disk.mounted()) GTEST_SKIP() << "only root may mount the small disk";

  const test::ProgramEnd full = test::RunScoria(Command(file, out));
  EXPECT_EQ(full.code, 4);
  EXPECT_NE(full.output.find("no space left on device\n"), std::string::npos) << full.output;
  EXPECT_NE(full.output.find("make room, and then the same command goes on with them\n"),
            std::string::npos)
      << full.output;
  disk.Grow(10 * seeds);

  pid_t campaign = test::StartScoria(Command(file, out));
  const pid_t worker = AnyWorker(campaign);
  if (worker != 0) kill(worker, SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(campaign, SIGKILL);
  (void)test::WaitFor(campaign);
  for (const auto& episode : fs::directory_iterator(out / "episodes")) {
    if (!fs::exists(episode.path() / "result.json")) continue;
    fs::resize_file(episode.path() / "result.json", 100);
    break;
  }
  const test::ProgramEnd last = test::RunScoria(Command(file, out));
  EXPECT_EQ(last.code, 0) << last.output;
  EXPECT_NE(last.output.find("(the result cannot be read)\n"), std::string::npos) << last.output;
  EXPECT_EQ(Walk(file, folder.path() / "undisturbed").unfinished, 0);
  EXPECT_EQ(Table(out), Table(folder.path() / "undisturbed"));
}

}  // namespace
}  // namespace scoria::app
