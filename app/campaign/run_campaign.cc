// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>

#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/campaign/campaign.h"
#include "app/campaign/episode_folder.h"
#include "app/campaign/executor.h"
#include "app/cli/exit_codes.h"
#include "app/cli/progress.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

/// One pass over the episodes that lack a result.
class CampaignRunner {
 public:
  CampaignRunner(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                 const CampaignOptions& options)
      : jobs_(jobs),
        options_(options),
        pool_(MakeLocalPool(options.program, options.workers)),
        episodes_(options.folder / "episodes"),
        bar_(campaign.name) {
    outcome_.episodes = static_cast<int>(jobs.size());
    FindWaiting();
  }

  CampaignOutcome Run() {
    while (true) {
      while (MayStart()) Start();
      if (pool_->IsIdle()) break;
      if (stopped()) pool_->Stop();
      if (const auto ended = pool_->Wait()) Guarded([&] { Take(*ended->job, ended->exit); });
      ShowProgress();
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
    return !stopped() && outcome_.disk_problem.empty() && !waiting_.empty() && pool_->HasRoom();
  }

  void Start() {
    const CampaignJob& job = *waiting_.back();
    Guarded([&] {
      const fs::path folder = episodes_ / job.id;
      PrepareFolder(folder, job);
      pool_->Start(job, folder);
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

  void ShowProgress() {
    bar_.Update(static_cast<double>(done_) / static_cast<double>(jobs_.size()),
                fmt::format("{}/{} episodes, {} falls, {} crashed", done_, jobs_.size(), falls_,
                            outcome_.crashed));
  }

  /// What a worker left.
  void Take(const CampaignJob& job, const JobExit& exit) {
    const fs::path folder = episodes_ / job.id;
    switch (Judge(exit, folder)) {
      case WorkerEnd::kResult: {
        const json result = *ReadResult(folder);
        falls_ += result.value("falls", 0);
        if (exit.code == kFailed) ++outcome_.failed;
        break;
      }
      case WorkerEnd::kCrashed:
        ++outcome_.unfinished;  // until its death is written
        WriteCrash(folder, job, exit);
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
  std::unique_ptr<Executor> pool_;
  fs::path episodes_;
  std::vector<const CampaignJob*> waiting_;
  CampaignOutcome outcome_;
  ProgressBar bar_;
  int done_ = 0, falls_ = 0;
};

}  // namespace

CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options) {
  const std::vector<CampaignJob> jobs = Plan(campaign);
  const core::FolderLock lock(options.folder, std::chrono::seconds(1));
  core::CreateFolders(options.folder / "episodes");
  WriteIndex(campaign, jobs, options.folder);
  return CampaignRunner(campaign, jobs, options).Run();
}

}  // namespace scoria::app
