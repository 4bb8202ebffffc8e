// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/run_jobs.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "app/campaign/episode_folder.h"
#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

class JobLoop {
 public:
  JobLoop(std::span<const FolderJob> jobs, const JobsOptions& options)
      : jobs_(jobs), options_(options), pool_(MakeLocalPool(options.program, options.workers)) {}

  JobsEnd Run() {
    while (true) {
      while (MayStart()) StartNext();
      if (pool_->IsIdle()) break;
      if (stopped()) pool_->Stop();
      if (const auto ended = pool_->Wait()) Guarded([&] { Take(*ended); });
      if (options_.on_moment) options_.on_moment();
    }
    end_.interrupted = stopped();
    for (; next_ < jobs_.size(); ++next_) end_.not_started += IsNeeded(jobs_[next_]) ? 1 : 0;
    return end_;
  }

 private:
  [[nodiscard]] bool stopped() const {
    return options_.interrupted != nullptr && options_.interrupted->load();
  }
  [[nodiscard]] bool MayStart() const {
    return !stopped() && end_.problem.empty() && next_ < jobs_.size() && pool_->HasRoom();
  }

  [[nodiscard]] bool IsNeeded(const FolderJob& job) const {
    return !options_.is_needed || options_.is_needed(job);
  }

  void StartNext() {
    if (!IsNeeded(jobs_[next_])) {
      ++next_;
      return;
    }
    Guarded([&] {
      const FolderJob& job = jobs_[next_];
      PrepareFolder(job.folder, *job.job);
      pool_->Start(*job.job, job.folder);
      ++next_;
    });
  }

  void Take(const EndedJob& ended) {
    const auto job = std::ranges::find(jobs_, ended.job, &FolderJob::job);
    if (std::string problem = options_.on_end(*job, ended.exit); !problem.empty())
      end_.problem = std::move(problem);
  }

  template <class Action>
  void Guarded(Action action) {
    try {
      action();
    } catch (const fs::filesystem_error& e) {
      end_.problem = core::FileError(e.path1(), "refused", e.code().value()).what();
    } catch (const std::runtime_error& e) {
      end_.problem = e.what();
    }
  }

  std::span<const FolderJob> jobs_;
  const JobsOptions& options_;
  std::unique_ptr<Executor> pool_;
  std::size_t next_ = 0;
  JobsEnd end_;
};

}  // namespace

JobsEnd RunJobs(std::span<const FolderJob> jobs, const JobsOptions& options) {
  return JobLoop(jobs, options).Run();
}

}  // namespace scoria::app
