// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "controller/mpc/convex_mpc.h"

namespace scoria::controller {

/// Solves one MPC problem per tick, at once or on a thread of its own, and gives out the result of
/// tick k at tick k + latency_ticks: the same bits either way, because results are taken by their
/// number, never by their time. One thread submits and collects. Collect waits for a thread that is
/// not done; nothing else waits, and nothing locks or allocates after construction.
class MpcRunner {
 public:
  static constexpr int kMaxLatency = 5;

  struct Result {
    MpcResult mpc;
    std::int64_t tick = 0;
    double solve_s = 0.0;  // wall clock
  };

  /// `robot` is borrowed.
  MpcRunner(const MpcParams& params, const core::RobotDescription& robot, double gravity_mps2);
  ~MpcRunner();
  /// Waits until the thread of `other` has solved what was submitted; then both have every result
  /// that is still to be collected, and the same warm start. To be called between Submit and the
  /// next, by the thread that submits.
  MpcRunner(const MpcRunner& other);
  MpcRunner& operator=(const MpcRunner&) = delete;

  /// Where the next problem is put together; valid until Submit.
  [[nodiscard]] MpcInput& input() noexcept { return jobs_[Slot(submitted_)].input; }
  void Submit() noexcept;
  /// Result of the tick latency_ticks before the last submitted one, or of the first tick.
  [[nodiscard]] const Result& Collect() noexcept;

  /// The solver, for saving its problem; not while a thread works on the next one.
  [[nodiscard]] const ConvexMpc& mpc() const noexcept { return mpc_; }

 private:
  struct Job {
    MpcInput input;
    Result result;
  };
  // One slot more than there can be jobs between Submit and Collect.
  static constexpr std::int64_t kSlots = kMaxLatency + 2;
  [[nodiscard]] static std::size_t Slot(std::int64_t tick) noexcept {
    return static_cast<std::size_t>(tick % kSlots);
  }
  void Solve(std::int64_t tick) noexcept;
  void Work() noexcept;
  /// Until the job of `tick` is solved.
  void WaitFor(std::int64_t tick) const noexcept;

  int latency_;
  bool threaded_;
  ConvexMpc mpc_;
  std::array<Job, kSlots> jobs_;
  std::int64_t submitted_ = 0;               // by the control loop
  std::atomic<std::int64_t> available_ = 0;  // jobs that the thread may solve; -1 ends it
  std::atomic<std::int64_t> solved_ = 0;
  std::thread thread_;
};

}  // namespace scoria::controller
