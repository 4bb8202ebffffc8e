// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <cstdio>
#include <map>
#include <stdexcept>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "app/campaign/executor.h"
#include "app/cli/exit_codes.h"
#include "core/stopwatch.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

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

JobExit ToExit(int status, double wall_s) {
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status), wall_s};
  return {WEXITSTATUS(status), std::nullopt, wall_s};
}

class LocalPool final : public Executor {
 public:
  LocalPool(std::string program, int workers) : program_(std::move(program)), workers_(workers) {}

  [[nodiscard]] bool HasRoom() const override {
    return static_cast<int>(running_.size()) < workers_;
  }
  [[nodiscard]] bool IsIdle() const override { return running_.empty(); }

  void Start(const CampaignJob& job, const fs::path& folder) override {
    const pid_t pid = StartWorker(program_, folder);
    if (pid < 0) throw std::runtime_error("cannot start a worker process");
    running_[pid] = {&job, {}};
  }

  [[nodiscard]] std::optional<EndedJob> Wait() override {
    for (const auto& [pid, running] : running_) {
      int status = 0;
      if (waitpid(pid, &status, WNOHANG) != pid) continue;
      const EndedJob ended{running.job, ToExit(status, running.since_start.seconds())};
      running_.erase(pid);
      return ended;
    }
    constexpr timespec kMoment = {0, 20'000'000};
    nanosleep(&kMoment, nullptr);
    return std::nullopt;
  }

  void Stop() override {
    for (const auto& [pid, running] : running_) kill(pid, SIGTERM);
  }

 private:
  struct Running {
    const CampaignJob* job = nullptr;
    core::Stopwatch since_start;
  };
  std::string program_;
  int workers_;
  std::map<pid_t, Running> running_;
};

}  // namespace

std::unique_ptr<Executor> MakeLocalPool(const std::string& program, int workers) {
  return std::make_unique<LocalPool>(program, workers);
}

}  // namespace scoria::app
