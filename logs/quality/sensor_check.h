// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "logs/quality/quality_check.h"
#include "logs/quality/signal_values.h"
#include "logs/quality/span_list.h"

namespace scoria::logs {

/// Sensors as such: values that are not numbers or words of their own, samples that are repeated,
/// values that stay while the robot moves, values at the end of a sensor's range.
class SensorCheck : public QualityCheck {
 public:
  /// A value that stays this long is stuck, if the other joints travel kTravel_rad each meanwhile,
  /// and if it would have changed by kOwnTravel of its range, going on as it does at other times,
  /// and a joint by kOwnTravel_rad: one that hardly moves stays within its encoder's resolution.
  static constexpr double kStuck_s = 0.5, kTravel_rad = 0.15, kOwnTravel = 0.5,
                          kOwnTravel_rad = 0.1;
  static constexpr double kPause_s = 0.1;      // of the log: what stays over it may have changed
  static constexpr double kAtStop_rad = 0.01;  // of its limit: a joint may rest on its stop
  /// Foot sensors show their zero in the air, so that a whole stride has to pass.
  static constexpr double kFootStuck_s = 1.5, kFootTravel_rad = 1.0;

  explicit SensorCheck(const LogSubject& subject) : subject_(subject) {}
  void AddRow(const Row& row) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  /// One number of a signal.
  struct Course {
    std::optional<double> last = std::nullopt;
    double since_s = 0.0, travel_then_rad = 0.0;  // of the present run of equal values
    std::uint64_t run = 0, runs = 0;              // rows of it; how many runs there were
    double path = 0.0;                            // sum of all changes
    SpanList stuck;
    double low = 0.0, high = 0.0;  // and how often it stayed there for a while
    std::uint64_t low_runs = 0, high_runs = 0, low_rows = 0, high_rows = 0;
  };
  /// A signal as a whole.
  struct Repeats {
    std::vector<double> last;
    double since_s = 0.0;
    std::uint64_t run = 0, runs = 0, rows = 0;
    double span_s = 0.0;
  };
  struct Sentinel {
    double value = 0.0, first_s = 0.0, last_s = 0.0;
    std::uint64_t count = 0;
  };
  using Signal = std::size_t;  // of kMeasuredSignals

  void AddValues(Signal signal, std::span<const double> values, double time_s);
  void AddRepeats(Signal signal, std::span<const double> values, double time_s);
  void AddValue(Signal signal, std::size_t i, double value, double time_s);
  [[nodiscard]] bool IsAtStop(Signal signal, std::size_t i, double value) const;
  [[nodiscard]] bool IsStuck(Signal signal, std::size_t i, double time_s) const;
  void EndRun(Signal signal, std::size_t i, double time_s);
  [[nodiscard]] double TravelOfOthers(Signal signal, std::size_t i) const;
  [[nodiscard]] SpanList StuckSpans(Signal signal, std::size_t i) const;
  [[nodiscard]] std::vector<Finding> Sentinels() const;
  [[nodiscard]] std::vector<Finding> RepeatedSamples() const;
  [[nodiscard]] std::vector<Finding> StuckSensors() const;
  [[nodiscard]] std::vector<Finding> Saturations() const;
  [[nodiscard]] Finding StuckFinding(Signal signal, std::size_t i, const SpanList& spans) const;

  static constexpr std::size_t kNumSignals = kMeasuredSignals.size();
  LogSubject subject_;
  std::array<std::array<Course, 12>, kNumSignals> courses_;
  std::array<Repeats, kNumSignals> repeats_;
  std::array<std::map<double, Sentinel>, kNumSignals> sentinels_;  // a few each
  std::array<std::size_t, kNumSignals> sizes_{};
  double first_s_ = 0.0, last_s_ = 0.0, step_s_ = 0.0;
  std::uint64_t rows_ = 0;
};

}  // namespace scoria::logs
