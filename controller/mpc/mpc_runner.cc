// SPDX-License-Identifier: BSD-3-Clause
#include "controller/mpc/mpc_runner.h"

#include <algorithm>

#include "core/stopwatch.h"

namespace scoria::controller {

MpcRunner::MpcRunner(const MpcParams& params, const core::RobotDescription& robot,
                     double gravity_mps2)
    : latency_(params.latency_ticks),
      threaded_(params.threaded),
      mpc_(params, robot, gravity_mps2) {
  if (threaded_) thread_ = std::thread([this] { Work(); });
}

MpcRunner::MpcRunner(const MpcRunner& other)
    : latency_(other.latency_),
      threaded_(other.threaded_),
      mpc_((other.WaitFor(other.submitted_ - 1), other.mpc_)),
      jobs_(other.jobs_),
      submitted_(other.submitted_),
      available_(other.submitted_),
      solved_(other.submitted_) {
  if (threaded_) thread_ = std::thread([this] { Work(); });
}

MpcRunner::~MpcRunner() {
  if (!threaded_) return;
  available_.store(-1);
  available_.notify_one();
  thread_.join();
}

void MpcRunner::Solve(std::int64_t tick) noexcept {
  Job& job = jobs_[Slot(tick)];
  const core::Stopwatch stopwatch;
  job.result.mpc = mpc_.Solve(job.input);
  job.result.solve_s = stopwatch.seconds();
  job.result.tick = tick;
}

void MpcRunner::Work() noexcept {
  for (std::int64_t done = solved_.load();; ++done) {
    std::int64_t available = available_.load();
    while (available == done) {
      available_.wait(done);
      available = available_.load();
    }
    if (available < 0) return;
    Solve(done);
    solved_.store(done + 1);
    solved_.notify_one();
  }
}

void MpcRunner::WaitFor(std::int64_t tick) const noexcept {
  if (!threaded_) return;
  for (std::int64_t solved = solved_.load(); solved <= tick; solved = solved_.load())
    solved_.wait(solved);
}

void MpcRunner::Submit() noexcept {
  const std::int64_t tick = submitted_++;
  if (!threaded_) {
    Solve(tick);
    return;
  }
  available_.store(submitted_);
  available_.notify_one();
}

const MpcRunner::Result& MpcRunner::Collect() noexcept {
  const std::int64_t tick = std::max<std::int64_t>(0, submitted_ - 1 - latency_);
  WaitFor(tick);
  return jobs_[Slot(tick)].result;
}

}  // namespace scoria::controller
