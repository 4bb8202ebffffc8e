// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "app/campaign/campaign.h"
#include "app/campaign/executor.h"

namespace scoria::app {

/// A job, borrowed, and the folder that it is run in, which is emptied first.
struct FolderJob {
  const CampaignJob* job = nullptr;
  std::filesystem::path folder;
};

struct JobsOptions {
  int workers = 2;
  std::string program;  // the scoria executable
  const std::atomic<bool>* interrupted = nullptr;
  /// A job has ended. @returns why no further one shall start, in words; empty if they may.
  std::function<std::string(const FolderJob& job, const JobExit& exit)> on_end;
  std::function<void()> on_moment;  // many times a second
  /// Is looked at when a job is to start: those that are no longer needed are left out. Empty: all
  /// are.
  std::function<bool(const FolderJob& job)> is_needed = {};
};

struct JobsEnd {
  bool interrupted = false;
  std::string problem;  // why it ended early, in words
  int not_started = 0;  // of those that are needed
};

/// Runs jobs in worker processes, started in their order. What the system refuses (disk, process, a
/// folder in use) ends it in good order: those that run may finish.
JobsEnd RunJobs(std::span<const FolderJob> jobs, const JobsOptions& options);

}  // namespace scoria::app
