// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "analysis/report/json_text.h"
#include "app/campaign/campaign.h"
#include "app/cli/exit_codes.h"
#include "app/cli/progress.h"
#include "app/run/inputs.h"
#include "app/version.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Starts `scoria run` on a job; its output goes to the episode's folder. @returns its process,
/// negative if there can be none.
pid_t StartWorker(const std::string& program, const fs::path& folder) {
  const std::string scenario = (folder / "job.yaml").string(), out = folder.string(),
                    log = (folder / "worker.txt").string();
  const pid_t campaign = getpid(), pid = fork();
  if (pid != 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a worker does not outlive its campaign
  if (getppid() != campaign) _exit(kStopped);
  if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(kFileError);
  execl(program.c_str(), program.c_str(), "run", scenario.c_str(), "--out", out.c_str(), "--quiet",
        nullptr);
  _exit(127);
}

/// The result in an episode's folder, if there is one that can be read.
std::optional<json> ReadResult(const fs::path& folder) {
  json result = json::parse(core::ReadText(folder / "result.json"), nullptr, false);
  const bool whole = result.is_object() && result.contains("end") && result["end"].is_string() &&
                     result.value("falls", json(0)).is_number();
  return whole ? std::optional(std::move(result)) : std::nullopt;
}

std::string EndOf(const json& result) { return result["end"].get<std::string>(); }

enum class WorkerEnd { kResult, kCrashed, kUnfinished, kDiskRefused };

/// Signals by which a program ends itself; all others come from outside.
bool IsOwnFault(int signal) {
  constexpr std::array<int, 7> kOwn = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP};
  return std::ranges::find(kOwn, signal) != kOwn.end();
}

WorkerEnd Judge(int status, const fs::path& folder) {
  if (WIFSIGNALED(status))
    return IsOwnFault(WTERMSIG(status)) ? WorkerEnd::kCrashed : WorkerEnd::kUnfinished;
  const int code = WEXITSTATUS(status);
  if (code == kStopped) return WorkerEnd::kUnfinished;
  if (code == kFileError) return WorkerEnd::kDiskRefused;
  if (code != kOk && code != kFailed) return WorkerEnd::kCrashed;
  if (ReadResult(folder)) return WorkerEnd::kResult;
  const bool unreadable = code == kOk || fs::exists(folder / "result.json");
  return unreadable ? WorkerEnd::kUnfinished : WorkerEnd::kCrashed;
}

/// What a worker said at its end.
std::string WordsOf(const fs::path& folder) {
  std::string words = core::ReadText(folder / "worker.txt");
  while (words.ends_with('\n')) words.pop_back();
  return words;
}

/// A worker that died leaves its death as the episode's result.
void WriteCrash(const fs::path& folder, const CampaignJob& job, int status) {
  const std::string how = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  const std::string words = WordsOf(folder);
  const json result = {{"scenario", job.id},
                       {"seed", job.seed},
                       {"end", "crashed"},
                       {"version", kVersion},
                       {"inputs", InputHasher().Hash(job.scenario)},
                       {"how", how},
                       {"message", words.empty() ? how : how + ": " + words}};
  core::WriteText(folder / "result.json", analysis::JsonText(result));
}

/// Why what stands in the folder is no result of this job, in words; empty if it is one.
std::string WhyAgain(const fs::path& folder, const CampaignJob& job, InputHasher& hasher) {
  const std::optional<json> result = ReadResult(folder);
  if (!result)
    return fs::exists(folder / "result.json") ? "the result cannot be read" : "there is no result";
  if (EndOf(*result) == "interrupted") return "interrupted";
  if (result->value("version", json()) != kVersion) return "walked by another version of scoria";
  if (core::ReadText(folder / "job.yaml") != EffectiveYaml(job.scenario))
    return "the scenario has changed";
  const json inputs = result->value("inputs", json::object());
  InputHashes before;
  for (const auto& [file, hash] : inputs.items())
    before[file] = hash.is_string() ? hash.get<std::string>() : "";
  return DescribeChange(before, hasher.Hash(job.scenario));
}

void WriteIndex(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                const fs::path& folder) {
  json index = {{"name", campaign.name},
                {"arms", json::array()},
                {"sweep", json::array()},
                {"episodes", json::array()}};
  for (const CampaignArm& arm : campaign.arms) index["arms"].push_back(arm.name);
  for (const CampaignAxis& axis : campaign.sweep) {
    index["sweep"].push_back({{"key", axis.key},
                              {"label", axis.label},
                              {"values", axis.names},
                              {"baseline", axis.baseline}});
  }
  for (const CampaignJob& job : jobs) {
    index["episodes"].push_back(
        {{"id", job.id}, {"arm", job.arm}, {"point", job.point}, {"seed", job.seed}});
  }
  core::WriteText(folder / "campaign.json", analysis::JsonText(index));
}

/// Empties an episode's folder once no worker of an earlier campaign writes to it any more.
void PrepareFolder(const fs::path& folder, const CampaignJob& job) {
  constexpr std::chrono::seconds kPatience(10);  // the workers of a killed campaign are dying
  const core::FolderLock lock(folder, kPatience);
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != ".lock") fs::remove_all(entry.path());
  }
  core::WriteText(folder / "job.yaml", EffectiveYaml(job.scenario));
}

/// One pass over the episodes that lack a result.
class CampaignRunner {
 public:
  CampaignRunner(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                 const CampaignOptions& options)
      : jobs_(jobs),
        options_(options),
        episodes_(options.folder / "episodes"),
        bar_(campaign.name) {
    outcome_.episodes = static_cast<int>(jobs.size());
    FindWaiting();
  }

  CampaignOutcome Run() {
    while (true) {
      while (MayStart()) Start();
      if (running_.empty()) break;
      int status = 0;
      const pid_t pid = waitpid(-1, &status, WNOHANG);
      const auto found = running_.find(pid);
      if (found == running_.end()) {
        Idle();
        continue;
      }
      const CampaignJob& job = *found->second;
      running_.erase(found);
      Guarded([&] { Take(job, status); });
    }
    outcome_.interrupted = stopped();
    outcome_.unfinished += static_cast<int>(waiting_.size());
    return outcome_;
  }

 private:
  /// Seeds first, arms last: an early look at a running campaign compares arms on equal ground.
  void FindWaiting() {
    InputHasher hasher;
    std::map<std::string, int> again;
    for (const CampaignJob& job : jobs_) {
      const fs::path folder = episodes_ / job.id;
      const std::string reason = WhyAgain(folder, job, hasher);
      if (reason.empty()) {
        ++outcome_.done_before;
        continue;
      }
      waiting_.push_back(&job);
      if (fs::exists(folder)) ++again[reason];
    }
    if (options_.on_again) {
      for (const auto& [reason, episodes] : again) options_.on_again(reason, episodes);
    }
    std::ranges::stable_sort(waiting_, {}, &CampaignJob::seed);
    std::ranges::reverse(waiting_);  // taken from the back
    done_ = outcome_.done_before;
  }

  [[nodiscard]] bool stopped() const {
    return options_.interrupted != nullptr && options_.interrupted->load();
  }
  [[nodiscard]] bool MayStart() const {
    return !stopped() && outcome_.disk_problem.empty() && !waiting_.empty() &&
           static_cast<int>(running_.size()) < options_.workers;
  }

  void Start() {
    const CampaignJob& job = *waiting_.back();
    Guarded([&] {
      const fs::path folder = episodes_ / job.id;
      PrepareFolder(folder, job);
      const pid_t pid = StartWorker(options_.program, folder);
      if (pid < 0) throw std::runtime_error("cannot start a worker process");
      running_[pid] = &job;
      waiting_.pop_back();
    });
  }

  /// What the system refuses (disk, process, a folder in use) ends the campaign in good order:
  /// those that run may finish.
  template <class Action>
  void Guarded(Action action) {
    try {
      action();
    } catch (const fs::filesystem_error& e) {
      outcome_.disk_problem = core::FileError(e.path1(), "refused", e.code().value()).what();
    } catch (const std::runtime_error& e) {
      outcome_.disk_problem = e.what();
    }
  }

  void Idle() {
    if (stopped()) {
      for (const auto& [worker, job] : running_) kill(worker, SIGTERM);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    bar_.Update(static_cast<double>(done_) / static_cast<double>(jobs_.size()),
                fmt::format("{}/{} episodes, {} falls, {} crashed", done_, jobs_.size(), falls_,
                            outcome_.crashed));
  }

  /// What a worker left.
  void Take(const CampaignJob& job, int status) {
    const fs::path folder = episodes_ / job.id;
    switch (Judge(status, folder)) {
      case WorkerEnd::kResult: {
        const json result = *ReadResult(folder);
        falls_ += result.value("falls", 0);
        if (WEXITSTATUS(status) == kFailed) ++outcome_.failed;
        break;
      }
      case WorkerEnd::kCrashed:
        ++outcome_.unfinished;  // until its death is written
        WriteCrash(folder, job, status);
        --outcome_.unfinished;
        ++outcome_.crashed;
        break;
      case WorkerEnd::kDiskRefused:
        ++outcome_.unfinished;
        outcome_.disk_problem = WordsOf(folder);
        if (outcome_.disk_problem.empty())  // there was no room for it
          outcome_.disk_problem = core::FileError(folder, "cannot write", ENOSPC).what();
        return;
      case WorkerEnd::kUnfinished:
        ++outcome_.unfinished;
        return;
    }
    ++done_;
  }

  const std::vector<CampaignJob>& jobs_;
  const CampaignOptions& options_;
  fs::path episodes_;
  std::vector<const CampaignJob*> waiting_;
  std::map<pid_t, const CampaignJob*> running_;
  CampaignOutcome outcome_;
  ProgressBar bar_;
  int done_ = 0, falls_ = 0;
};

}  // namespace

CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options) {
  const std::vector<CampaignJob> jobs = AllJobs(campaign);
  const core::FolderLock lock(options.folder, std::chrono::seconds(1));
  core::CreateFolders(options.folder / "episodes");
  WriteIndex(campaign, jobs, options.folder);
  return CampaignRunner(campaign, jobs, options).Run();
}

}  // namespace scoria::app
