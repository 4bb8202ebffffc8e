// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <map>

#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/campaign/baseline.h"
#include "app/campaign/campaign.h"
#include "app/campaign/episode_folder.h"
#include "app/campaign/run_jobs.h"
#include "app/campaign/stop_when_decided.h"
#include "app/cli/exit_codes.h"
#include "app/cli/progress.h"
#include "app/version.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One pass over the episodes that lack a result.
class CampaignRunner {
 public:
  CampaignRunner(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                 const CampaignOptions& options)
      : jobs_(jobs), options_(options), bar_(campaign.name) {
    if (campaign.stop) stop_.emplace(campaign, jobs, options.folder);
    FindWaiting();
  }

  CampaignOutcome Run() {
    JobsOptions options{options_.workers, options_.program, options_.interrupted, {}, {}};
    options.on_end = [this](const FolderJob& job, const JobExit& exit) { return Take(job, exit); };
    options.on_moment = [this] { ShowProgress(); };
    options.is_needed = [this](const FolderJob& job) { return Needs(*job.job); };
    const JobsEnd end = RunJobs(waiting_, options);
    outcome_.interrupted = end.interrupted;
    outcome_.unfinished += end.not_started;
    outcome_.disk_problem = end.problem;
    outcome_.episodes = static_cast<int>(
        std::ranges::count_if(jobs_, [this](const CampaignJob& job) { return Needs(job); }));
    if (stop_) outcome_.stop = stop_->record();
    return outcome_;
  }

 private:
  /// Seeds first, arms last: an early look at a running campaign compares arms on equal ground.
  void FindWaiting() {
    InputHasher hasher;
    std::map<std::string, int> again;
    std::vector<const CampaignJob*> done;
    for (const CampaignJob& job : jobs_) {
      const fs::path folder = options_.folder / "episodes" / job.id;
      const std::string reason = WhyAgain(folder, job, hasher);
      if (reason.empty()) {
        done.push_back(&job);
        if (stop_) stop_->Take(job);
        continue;
      }
      waiting_.push_back({&job, folder});
      if (fs::exists(folder)) ++again[reason];
    }
    if (options_.on_again) {
      for (const auto& [reason, episodes] : again) options_.on_again(reason, episodes);
    }
    std::erase_if(waiting_, [this](const FolderJob& j) { return !Needs(*j.job); });
    std::ranges::stable_sort(waiting_, {}, [](const FolderJob& j) { return j.job->seed; });
    done_ = outcome_.done_before = static_cast<int>(
        std::ranges::count_if(done, [this](const CampaignJob* job) { return Needs(*job); }));
  }

  [[nodiscard]] bool Needs(const CampaignJob& job) const { return !stop_ || stop_->Needs(job); }

  void ShowProgress() {
    bar_.Update(static_cast<double>(done_) / static_cast<double>(jobs_.size()),
                fmt::format("{}/{} episodes, {} falls, {} crashed", done_, jobs_.size(), falls_,
                            outcome_.crashed));
  }

  /// What a worker left. @returns why the campaign has to end, in words; empty if it may go on.
  std::string Take(const FolderJob& job, const JobExit& exit) {
    switch (Judge(exit, job.folder)) {
      case WorkerEnd::kResult: {
        const json result = *ReadResult(job.folder);
        falls_ += result.value("falls", 0);
        if (exit.code == kFailed) ++outcome_.failed;
        break;
      }
      case WorkerEnd::kCrashed:
        ++outcome_.unfinished;  // until its death is written
        WriteCrash(job.folder, *job.job, exit);
        --outcome_.unfinished;
        ++outcome_.crashed;
        break;
      case WorkerEnd::kDiskRefused:
        ++outcome_.unfinished;
        return WhyDiskRefused(job.folder);
      case WorkerEnd::kUnfinished:
        ++outcome_.unfinished;
        return "";
    }
    ++done_;
    if (stop_) stop_->Take(*job.job);
    return "";
  }

  const std::vector<CampaignJob>& jobs_;
  const CampaignOptions& options_;
  std::vector<FolderJob> waiting_;
  std::optional<StopWhenDecided> stop_;  // of a campaign that may stop by itself
  CampaignOutcome outcome_;
  ProgressBar bar_;
  int done_ = 0, falls_ = 0;
};

}  // namespace

void WriteIndex(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                const fs::path& folder, const std::optional<analysis::StopRecord>& stop) {
  json index = {{"name", campaign.name},
                {"file", campaign.file.string()},
                {"overrides", campaign.overrides},
                {"cpu", CpuName()},
                {"version", kVersion},
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
  if (campaign.design) index["design"] = analysis::ToJson(*campaign.design);
  if (stop) index["stop"] = analysis::ToJson(*stop);
  for (const CampaignJob& job : jobs) {
    if (stop && stop->last_seed && job.seed > *stop->last_seed) continue;
    index["episodes"].push_back(
        {{"id", job.id}, {"arm", job.arm}, {"point", job.point}, {"seed", job.seed}});
  }
  core::WriteText(folder / "campaign.json", analysis::JsonText(index));
}

CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options) {
  const std::vector<CampaignJob> jobs = Plan(campaign);
  const core::FolderLock lock(options.folder, std::chrono::seconds(1));
  core::CreateFolders(options.folder / "episodes");
  WriteIndex(campaign, jobs, options.folder);
  CampaignOutcome outcome = CampaignRunner(campaign, jobs, options).Run();
  if (outcome.stop) WriteIndex(campaign, jobs, options.folder, outcome.stop);
  return outcome;
}

}  // namespace scoria::app
