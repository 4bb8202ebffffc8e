// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "core/robot/legs.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Strides of about one length, added up.
struct StrideBin {
  std::uint64_t count = 0;
  double stride_s = 0.0, stance_s = 0.0;  // sums
  StrideBin& operator+=(const StrideBin& other) noexcept;
  bool operator==(const StrideBin&) const = default;
};

/// Strides of one leg, from touchdown to touchdown. Means are of the regular ones, from 2/3 to 3/2
/// of the median stride: a stumble makes two short strides of one, a touchdown that was missed one
/// long stride of two.
struct LegTiming {
  static constexpr double kBin_s = 0.02, kRegular = 1.5;
  std::map<int, StrideBin> bins;  // by stride over kBin_s
  /// Sum of exp(2πi φ), φ the touchdown's place in the front left leg's stride, over `phases`.
  std::complex<double> phase;
  std::uint64_t phases = 0;
  void Add(double stride_s, double stance_s);
  [[nodiscard]] StrideBin Regular() const;
  [[nodiscard]] std::optional<double> MeanStride() const;  // s
  [[nodiscard]] std::optional<double> MeanStance() const;  // s
  [[nodiscard]] std::optional<double> Duty() const;        // share of stance
  [[nodiscard]] std::optional<double> Phase() const;       // in [0, 1)
  LegTiming& operator+=(const LegTiming& other);
  bool operator==(const LegTiming&) const = default;
};

/// From a touchdown of a foot to its next one.
struct Stride {
  double stride_s = 0.0, stance_s = 0.0;
};

/// Times of the gait of an episode, or of several added up.
struct GaitTiming {
  LegArray<LegTiming> legs;
  GaitTiming& operator+=(const GaitTiming& other);
  bool operator==(const GaitTiming&) const = default;
};

/// Measures strides from the contacts of the feet, in samples of any rate. A foot that is off the
/// ground, or on it, for less than kBounce_s has not moved from stance to swing, or back; longer
/// strides than kLongest_s are standing.
class GaitTimer {
 public:
  static constexpr double kBounce_s = 0.08, kLongest_s = 3.0;

  /// @param on_stride  if there is one: is told of the strides of any leg that end with this
  /// sample.
  using OnStride = std::function<void(const Stride&)>;
  void Add(double time_s, const logs::PerLeg<bool>& contact, const OnStride& on_stride = {});
  /// Samples before and after belong to different stretches of walking.
  void Break() noexcept;
  [[nodiscard]] const GaitTiming& timing() const noexcept { return timing_; }

 private:
  struct LegState {
    bool on = false, raw = false;        // without bounces; the last sample
    std::optional<double> raw_s;         // since when that is; none: since the stretch began
    std::optional<double> down_s, up_s;  // of the stride that is under way
  };
  void Settle(Leg leg, LegState& state, const OnStride& on_stride);
  void Touchdown(Leg leg, double time_s, const OnStride& on_stride);

  GaitTiming timing_;
  LegArray<LegState> legs_;
  bool started_ = false;
  double last_s_ = 0.0;
  std::optional<double> reference_s_, reference_stride_s_;  // of the front left leg
};

}  // namespace scoria::analysis
