// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/campaign/campaign.h"

namespace scoria::app {

/// How the process of a job ended.
struct JobExit {
  int code = 0;               // its exit code, where no signal ended it
  std::optional<int> signal;  // that ended it
  double wall_s = 0.0;        // since its start
};

struct EndedJob {
  const CampaignJob* job;
  JobExit exit;
};

/// Where a campaign's jobs run: each is `scoria run` on the job.yaml of its folder, in a process of
/// its own.
class Executor {
 public:
  virtual ~Executor() = default;
  /// @returns true if one more job may start.
  [[nodiscard]] virtual bool HasRoom() const = 0;
  /// @returns true if none runs.
  [[nodiscard]] virtual bool IsIdle() const = 0;
  /// `job` is borrowed until it has ended. @pre HasRoom().
  /// Errors: std::runtime_error if the system refuses.
  virtual void Start(const CampaignJob& job, const std::filesystem::path& folder) = 0;
  /// Waits a moment for a job to end.
  [[nodiscard]] virtual std::optional<EndedJob> Wait() = 0;
  /// Asks the jobs that run to end soon.
  virtual void Stop() = 0;
};

/// Worker processes on this machine, at most `workers` at a time, none of which outlives the
/// campaign. It waits for its own children only.
/// @param program  the scoria executable.
[[nodiscard]] std::unique_ptr<Executor> MakeLocalPool(const std::string& program, int workers);

}  // namespace scoria::app
