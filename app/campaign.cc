// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/campaign_file.h"
#include "app/config_kinds.h"
#include "app/progress.h"
#include "app/scenario.h"
#include "app/version.h"
#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using core::ConfigError;
using core::ConfigNode;

CampaignArm ToArm(const ArmFile& file) { return {file.name, file.set.node}; }

void AddValue(const ConfigNode& value, CampaignAxis& axis) {
  ConfigNode set;
  set.kind = ConfigNode::Kind::kMap;
  core::SetAt(set, axis.key, value);
  axis.sets.push_back(std::move(set));
  axis.names.push_back(value.kind == ConfigNode::Kind::kScalar ? value.scalar
                                                               : core::EmitYaml(value));
}

/// @param node  of the axis, for places in messages.
CampaignAxis MakeAxis(const AxisFile& file, const ConfigNode& node, std::size_t index) {
  const std::string path = fmt::format("sweep[{}]", index);
  CampaignAxis axis{file.key, file.label, {}, {}, file.baseline};
  const ConfigNode *values = node.Find("values"), *variants = node.Find("variants");
  if (variants != nullptr && (values != nullptr || !axis.key.empty()))
    throw ConfigError(variants->origin, path + ".variants", "stands in place of key and values");
  if (variants != nullptr && axis.label.empty())
    throw ConfigError(node.origin, path + ".label", "is missing; variants need one");
  if (variants == nullptr && axis.key.empty())
    throw ConfigError(node.origin, path + ".key", "is missing and has no default");
  if (axis.label.empty()) axis.label = axis.key;
  if (file.values.empty() && file.variants.empty())
    throw ConfigError(node.origin, path + (variants != nullptr ? ".variants" : ".values"),
                      "must list at least one");
  for (const ConfigNode& value : file.values) AddValue(value, axis);
  for (const ArmFile& variant : file.variants) {
    axis.sets.push_back(variant.set.node);
    axis.names.push_back(variant.name);
  }
  if (axis.key.empty()) axis.key = axis.label;
  if (!axis.baseline.empty() && !std::ranges::count(axis.names, axis.baseline))
    throw ConfigError(node.Find("baseline")->origin, path + ".baseline",
                      fmt::format("{}: is none of the {}", axis.baseline,
                                  variants != nullptr ? "variants" : "values"));
  return axis;
}

/// One episode to run.
struct Job {
  std::string id, arm;
  std::vector<std::string> point;  // value per axis
  std::uint64_t seed = 0;
  std::string scenario_yaml;
};

/// Every combination of the axes' values, by index.
void AddJobs(const Campaign& campaign, const CampaignArm& arm, std::vector<std::size_t>& point,
             std::vector<Job>& jobs) {
  if (point.size() < campaign.sweep.size()) {
    for (std::size_t i = 0; i < campaign.sweep[point.size()].names.size(); ++i) {
      point.push_back(i);
      AddJobs(campaign, arm, point, jobs);
      point.pop_back();
    }
    return;
  }
  ConfigNode node = campaign.scenario;
  if (arm.set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, arm.set);
  for (std::size_t i = 0; i < point.size(); ++i) {
    const ConfigNode& set = campaign.sweep[i].sets[point[i]];
    if (set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, set);
  }
  for (int k = 0; k < campaign.seeds; ++k) {
    Scenario scenario = core::ReadConfig<Scenario>(node);
    Job job;
    job.arm = arm.name;
    job.seed = scenario.seed = campaign.first_seed + static_cast<std::uint64_t>(k);
    job.id = core::FileNameOf(arm.name);
    for (std::size_t i = 0; i < point.size(); ++i) {
      job.point.push_back(campaign.sweep[i].names[point[i]]);
      job.id += "-" + core::FileNameOf(job.point.back());
    }
    job.id += fmt::format("-s{}", job.seed);
    scenario.name = job.id;
    job.scenario_yaml = EffectiveYaml(scenario);
    jobs.push_back(std::move(job));
  }
}

std::vector<Job> AllJobs(const Campaign& campaign) {
  std::vector<Job> jobs;
  for (const CampaignArm& arm : campaign.arms) {
    std::vector<std::size_t> point;
    AddJobs(campaign, arm, point, jobs);
  }
  std::set<std::string> ids;
  for (const Job& job : jobs) {
    if (!ids.insert(job.id).second) {
      throw ConfigError(
          campaign.scenario.origin, "arms, sweep",
          fmt::format("two episodes would share the folder {}; give arms and values distinct names",
                      job.id));
    }
  }
  return jobs;
}

/// Starts `scoria run` on a job; its output goes to the episode's folder.
pid_t StartWorker(const std::string& program, const fs::path& folder) {
  const std::string scenario = (folder / "job.yaml").string(), out = folder.string(),
                    log = (folder / "worker.txt").string();
  const pid_t pid = fork();
  if (pid != 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // a worker does not outlive its campaign
  if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(127);
  execl(program.c_str(), program.c_str(), "run", scenario.c_str(), "--out", out.c_str(), "--quiet",
        nullptr);
  _exit(127);
}

/// A worker that died leaves its death as the episode's result.
void WriteCrash(const fs::path& folder, const Job& job, int status) {
  const std::string how = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  const nlohmann::json json = {
      {"scenario", job.id}, {"seed", job.seed},
      {"end", "crashed"},   {"version", kVersion},
      {"how", how},         {"message", core::ReadText(folder / "worker.txt")}};
  core::WriteText(folder / "result.json",
                  json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

/// A result of this very scenario by this very version, not of an interrupted episode.
bool IsDone(const fs::path& folder, const Job& job) {
  if (!fs::exists(folder / "result.json") ||
      core::ReadText(folder / "job.yaml") != job.scenario_yaml)
    return false;
  const nlohmann::json result =
      nlohmann::json::parse(core::ReadText(folder / "result.json"), nullptr, false);
  return !result.is_discarded() && result.value("end", "interrupted") != "interrupted" &&
         result.value("version", "") == kVersion;
}

void WriteIndex(const Campaign& campaign, const std::vector<Job>& jobs, const fs::path& folder) {
  nlohmann::json index = {{"name", campaign.name},
                          {"arms", nlohmann::json::array()},
                          {"sweep", nlohmann::json::array()},
                          {"episodes", nlohmann::json::array()}};
  for (const CampaignArm& arm : campaign.arms) index["arms"].push_back(arm.name);
  for (const CampaignAxis& axis : campaign.sweep) {
    index["sweep"].push_back({{"key", axis.key},
                              {"label", axis.label},
                              {"values", axis.names},
                              {"baseline", axis.baseline}});
  }
  for (const Job& job : jobs) {
    index["episodes"].push_back(
        {{"id", job.id}, {"arm", job.arm}, {"point", job.point}, {"seed", job.seed}});
  }
  core::WriteText(folder / "campaign.json", index.dump(2) + "\n");
}

}  // namespace

Campaign LoadCampaign(const fs::path& file, const std::vector<std::string>& overrides) {
  const ConfigNode node = LoadKind("campaign", file, overrides);
  const auto read = core::ReadConfig<CampaignFile>(node);
  if (read.arms.empty())
    throw ConfigError(node.Find("arms")->origin, "arms", "must list at least one arm");
  Campaign campaign;
  campaign.name = read.name;
  campaign.scenario = read.scenario.node;
  campaign.first_seed = read.first_seed;
  campaign.seeds = read.seeds;
  for (const ArmFile& arm : read.arms) campaign.arms.push_back(ToArm(arm));
  for (std::size_t i = 0; i < read.sweep.size(); ++i)
    campaign.sweep.push_back(MakeAxis(read.sweep[i], node.Find("sweep")->items[i], i));
  (void)AllJobs(campaign);  // checks every scenario
  return campaign;
}

CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options) {
  const std::vector<Job> jobs = AllJobs(campaign);
  const fs::path episodes = options.folder / "episodes";
  fs::create_directories(episodes);
  WriteIndex(campaign, jobs, options.folder);

  CampaignOutcome outcome;
  outcome.episodes = static_cast<int>(jobs.size());
  std::vector<const Job*> waiting;
  for (const Job& job : jobs) {
    if (IsDone(episodes / job.id, job)) {
      ++outcome.done_before;
    } else {
      waiting.push_back(&job);
    }
  }
  // Seeds first, arms last: an early look at a running campaign compares arms on equal ground.
  std::stable_sort(waiting.begin(), waiting.end(),
                   [](const Job* a, const Job* b) { return a->seed < b->seed; });
  std::reverse(waiting.begin(), waiting.end());  // taken from the back

  std::map<pid_t, const Job*> running;
  ProgressBar bar(campaign.name);
  int done = outcome.done_before, falls = 0;
  const auto stopped = [&] {
    return options.interrupted != nullptr && options.interrupted->load();
  };
  while (!waiting.empty() || !running.empty()) {
    while (!stopped() && !waiting.empty() && static_cast<int>(running.size()) < options.workers) {
      const Job& job = *waiting.back();
      waiting.pop_back();
      const fs::path folder = episodes / job.id;
      fs::remove_all(folder);
      fs::create_directories(folder);
      core::WriteText(folder / "job.yaml", job.scenario_yaml);
      const pid_t pid = StartWorker(options.program, folder);
      if (pid < 0) throw std::runtime_error("cannot start a worker process");
      running[pid] = &job;
    }
    if (stopped() && running.empty()) break;
    int status = 0;
    const pid_t pid = waitpid(-1, &status, WNOHANG);
    const auto found = running.find(pid);
    if (found == running.end()) {
      if (stopped()) {
        for (const auto& [worker, job] : running) kill(worker, SIGTERM);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      bar.Update(static_cast<double>(done) / static_cast<double>(jobs.size()),
                 fmt::format("{}/{} episodes, {} falls, {} crashed", done, jobs.size(), falls,
                             outcome.crashed));
      continue;
    }
    const Job& job = *found->second;
    const fs::path folder = episodes / job.id;
    running.erase(found);
    if (stopped()) {
      fs::remove(folder / "result.json");  // an interrupted episode is run again
      continue;
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !fs::exists(folder / "result.json")) {
      WriteCrash(folder, job, status);
      ++outcome.crashed;
    } else {
      falls += nlohmann::json::parse(core::ReadText(folder / "result.json")).at("falls").get<int>();
    }
    ++done;
  }
  outcome.interrupted = stopped();
  return outcome;
}

}  // namespace scoria::app
