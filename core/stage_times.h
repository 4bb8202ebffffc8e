// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/stopwatch.h"

namespace scoria::core {

/// What the wall clock of an episode goes to.
enum class Stage { kSensors, kEstimation, kPlans, kMpc, kBody, kPhysics, kRecord };
constexpr std::array<std::pair<Stage, std::string_view>, 7> EnumNames(Stage) {
  return {{{Stage::kSensors, "sensors and operator"},
           {Stage::kEstimation, "estimation and model"},
           {Stage::kPlans, "gait, reference, footholds"},
           {Stage::kMpc, "MPC"},
           {Stage::kBody, "swing and body control"},
           {Stage::kPhysics, "actuation and physics"},
           {Stage::kRecord, "record and metrics"}}};
}

/// Wall-clock seconds per stage.
class StageTimes {
 public:
  [[nodiscard]] double operator[](Stage stage) const noexcept { return s_[Index(stage)]; }
  void Add(Stage stage, double seconds) noexcept { s_[Index(stage)] += seconds; }
  StageTimes& operator+=(const StageTimes& other) noexcept {
    for (std::size_t i = 0; i < s_.size(); ++i) s_[i] += other.s_[i];
    return *this;
  }
  [[nodiscard]] double sum() const noexcept {
    double sum = 0.0;
    for (const double s : s_) sum += s;
    return sum;
  }

 private:
  [[nodiscard]] static std::size_t Index(Stage stage) noexcept {
    return static_cast<std::size_t>(stage);
  }
  std::array<double, EnumNames(Stage{}).size()> s_{};
};

/// Books the time since its last call, or its start, on a stage.
class Lap {
 public:
  explicit Lap(StageTimes& times) noexcept : times_(&times) {}
  void Book(Stage stage) noexcept {
    times_->Add(stage, stopwatch_.seconds());
    stopwatch_ = Stopwatch();
  }

 private:
  StageTimes* times_;
  Stopwatch stopwatch_;
};

}  // namespace scoria::core
