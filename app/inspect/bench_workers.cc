// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/bench_workers.h"

#include <stdexcept>

#include <fmt/format.h>

#include "app/campaign/episode_folder.h"
#include "app/campaign/run_jobs.h"
#include "core/stopwatch.h"
#include "logs/format/temporary_folder.h"

namespace scoria::app {
namespace {

double TimeJobs(const std::vector<FolderJob>& jobs, const std::string& program, int workers) {
  JobsOptions options{workers, program, nullptr, {}, {}};
  options.on_end = [](const FolderJob& job, const JobExit& exit) {
    return Judge(exit, job.folder) == WorkerEnd::kResult
               ? ""
               : fmt::format("{}: {}", job.job->id, WordsOf(job.folder));
  };
  const core::Stopwatch stopwatch;
  const JobsEnd end = RunJobs(jobs, options);
  if (!end.problem.empty()) throw std::runtime_error(end.problem);
  return stopwatch.seconds();
}

}  // namespace

std::vector<WorkersPair> BenchmarkWorkers(const Scenario& scenario, const std::string& program,
                                          int episodes, int pairs) {
  const logs::TemporaryFolder folder;
  std::vector<CampaignJob> episodes_of_it;
  for (int i = 0; i < episodes; ++i) {
    CampaignJob& job = episodes_of_it.emplace_back();
    job.scenario = scenario;
    job.scenario.log.keep = KeepLog::kMetrics;
    job.seed = job.scenario.seed = scenario.seed + static_cast<std::uint64_t>(i);
    job.id = fmt::format("{}", i);
  }
  std::vector<FolderJob> jobs;
  for (const CampaignJob& job : episodes_of_it) jobs.push_back({&job, folder.path() / job.id});
  std::vector<WorkersPair> all;
  for (int pair = 0; pair < pairs; ++pair) {
    WorkersPair& timed = all.emplace_back();
    timed.one_s = TimeJobs(jobs, program, 1);
    timed.two_s = TimeJobs(jobs, program, 2);
  }
  return all;
}

}  // namespace scoria::app
