// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/run_checks.h"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "app/campaign/episode_folder.h"
#include "app/campaign/run_jobs.h"
#include "app/check/failure_artifacts.h"
#include "app/check/judge_arms.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using analysis::CampaignResults;
using analysis::EpisodeRecord;

bool IsBroken(const Finding& finding) { return !finding.problem.empty(); }

/// A test on its way.
struct Progress {
  const CheckTest* test = nullptr;
  fs::path folder;
  std::size_t left = 0;  // episodes
  CheckOutcome outcome;
};

/// What is expected of every episode.
void JudgeEpisodes(const CheckTest& test, const CampaignResults& results, CheckOutcome& outcome) {
  const ExpectationJudge judge;
  for (std::size_t i = 0; i < results.episodes.size(); ++i) {
    const EpisodeRecord& e = results.episodes[i];
    for (Finding& f : judge.Compare(test.jobs[i].scenario.expect, {&e}, test.campaign ? e.id : ""))
      outcome.findings.push_back(std::move(f));
  }
}

void JudgeTest(const fs::path& folder, CheckOutcome& outcome) {
  const CheckTest& test = *outcome.test;
  const CampaignResults results = analysis::LoadResults(folder);
  for (const EpisodeRecord& e : results.episodes) {
    const std::string problem = DescribeNoWalk(e);
    if (problem.empty()) continue;
    outcome.errors.push_back(test.campaign ? fmt::format("{}: {}", e.id, problem) : problem);
  }
  if (!outcome.errors.empty()) {
    outcome.status = CheckStatus::kError;
    return;
  }
  JudgeEpisodes(test, results, outcome);
  if (test.campaign) {
    for (Finding& f : JudgeArms(test.campaign->expect, results))
      outcome.findings.push_back(std::move(f));
  }
  if (std::ranges::any_of(outcome.findings, IsBroken)) outcome.status = CheckStatus::kFailed;
}

/// The episode that shows a failure best: the one with most falls.
std::size_t MostFalls(const fs::path& folder) {
  const auto episodes = analysis::LoadResults(folder).episodes;
  const auto falls = [](const EpisodeRecord& e) { return e.metrics.falls.size(); };
  return static_cast<std::size_t>(std::ranges::max_element(episodes, {}, falls) - episodes.begin());
}

class CheckRunner {
 public:
  CheckRunner(const std::vector<CheckTest>& tests, const CheckOptions& options)
      : options_(options) {
    for (const CheckTest& test : tests) {
      const fs::path folder = options.folder / core::FileNameOf(test.name);
      for (const CampaignJob& job : test.jobs) {
        test_of_[&job] = progress_.size();
        jobs_.push_back({&job, test.campaign ? folder / "episodes" / job.id : folder});
      }
      Progress& p = progress_.emplace_back();
      p = {&test, folder, test.jobs.size(), {}};
      p.outcome.test = &test;
    }
  }

  CheckRun Run() {
    for (const Progress& p : progress_) {
      if (!p.test->campaign) continue;
      core::CreateFolders(p.folder);
      WriteIndex(*p.test->campaign, p.test->jobs, p.folder);
    }
    const JobsEnd end = RunJobs(jobs_, Options([this](const FolderJob& job, const JobExit& exit) {
                                  return Take(job, exit);
                                }));
    CheckRun run{{}, end.interrupted, end.problem};
    if (options_.artifacts && !end.interrupted && end.problem.empty()) ShowFailures(run);
    for (Progress& p : progress_) {
      if (p.left == 0) run.outcomes.push_back(std::move(p.outcome));
    }
    return run;
  }

 private:
  using OnEnd = std::function<std::string(const FolderJob&, const JobExit&)>;
  JobsOptions Options(OnEnd on_end) const {
    return {options_.workers, options_.program, options_.interrupted, std::move(on_end), [this] {
              if (options_.on_progress) options_.on_progress(done_, static_cast<int>(jobs_.size()));
            }};
  }

  std::string Take(const FolderJob& job, const JobExit& exit) {
    switch (Judge(exit, job.folder)) {
      case WorkerEnd::kDiskRefused:
        return WhyDiskRefused(job.folder);
      case WorkerEnd::kCrashed:
      case WorkerEnd::kUnfinished:
        if (options_.interrupted != nullptr && options_.interrupted->load()) return "";
        WriteCrash(job.folder, *job.job, exit);
        break;
      case WorkerEnd::kResult:
        break;
    }
    ++done_;
    Progress& p = progress_[test_of_.at(job.job)];
    p.outcome.wall_s += exit.wall_s;
    if (--p.left > 0) return "";
    JudgeTest(p.folder, p.outcome);
    if (options_.on_outcome) options_.on_outcome(p.outcome);
    return "";
  }

  /// Walks one episode of every failed test again, with its log.
  void ShowFailures(CheckRun& run) {
    std::vector<Progress*> failed;
    for (Progress& p : progress_) {
      if (p.outcome.status != CheckStatus::kPassed) failed.push_back(&p);
    }
    std::vector<CampaignJob> again;
    for (const Progress* p : failed) {
      again.push_back(p->test->jobs[p->test->campaign ? MostFalls(p->folder) : 0]);
      again.back().scenario.log = {.keep = KeepLog::kFull};
    }
    std::vector<FolderJob> jobs;
    for (std::size_t i = 0; i < again.size(); ++i)
      jobs.push_back({&again[i], failed[i]->folder / "failure"});
    const JobsEnd end = RunJobs(jobs, Options([&](const FolderJob& job, const JobExit& exit) {
                                  Progress& p =
                                      *failed[static_cast<std::size_t>(job.job - again.data())];
                                  return Draw(job, exit, p.outcome);
                                }));
    run.interrupted = end.interrupted;
    run.disk_problem = end.problem;
  }

  static std::string Draw(const FolderJob& job, const JobExit& exit, CheckOutcome& outcome) {
    if (Judge(exit, job.folder) == WorkerEnd::kDiskRefused) return WhyDiskRefused(job.folder);
    FailureArtifacts made = MakeFailureArtifacts(job.folder);
    outcome.artifacts = std::move(made.files);
    outcome.artifact_problem = std::move(made.problem);
    return "";
  }

  const CheckOptions& options_;
  std::vector<FolderJob> jobs_;
  std::map<const CampaignJob*, std::size_t> test_of_;
  std::vector<Progress> progress_;
  int done_ = 0;
};

}  // namespace

CheckRun RunChecks(const std::vector<CheckTest>& tests, const CheckOptions& options) {
  const core::FolderLock lock(options.folder);
  return CheckRunner(tests, options).Run();
}

}  // namespace scoria::app
