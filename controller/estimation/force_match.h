// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"

namespace scoria::controller {

struct ForceMatchParams {
  double zero_s = 1.0;
  double gain_s = 10.0;
  double tolerance_N = 12.0;
  double tolerance_share = 0.3;
  double load_share = 1.2;
  double cap_N = 40.0;
  double impulse_Ns = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field(
        "zero_s", zero_s,
        {.min = 0.05,
         .max = 60.0,
         .doc = "time constant of the zero, which drifts, in time in the air; nothing is judged "
                "before so long in the air and on the ground",
         .scale = core::dimension::kTime});
    a.Field("gain_s", gain_s,
            {.min = 0.05,
             .max = 600.0,
             .doc = "time constant of the gain, which hardly changes, in time on the ground",
             .scale = core::dimension::kTime});
    a.Field("tolerance_N", tolerance_N,
            {.min = 0.0,
             .max = 1e4,
             .doc = "by so much the counts may mean more than the observer's force for good: joint "
                    "friction",
             .scale = core::dimension::kForce});
    a.Field("tolerance_share", tolerance_share,
            {.min = 0.0,
             .max = 10.0,
             .doc = "and by this share of that force: slope of the ground under the foot"});
    a.Field("load_share", load_share,
            {.min = 0.0,
             .max = 100.0,
             .doc = "a foot that bears more than this share of its mean force is not judged: the "
                    "observer falls behind high loads"});
    a.Field("cap_N", cap_N,
            {.min = 0.0,
             .max = 1e4,
             .doc = "a larger excess counts as this: impacts, which the observer smooths",
             .scale = core::dimension::kForce});
    a.Field("impulse_Ns", impulse_Ns,
            {.min = 0.0,
             .max = 100.0,
             .doc = "excess over the tolerance, summed up over time, that is a fault",
             .scale = core::dimension::kForce * core::dimension::kTime});
  }
  bool operator==(const ForceMatchParams&) const = default;
};

struct ForceMatchInput {
  double raw_counts = 0.0;
  double force_N = 0.0;                    // normal, the observer's
  bool in_air = false, on_ground = false;  // surely, and settled; neither: nothing is judged
  bool learn = true;                       // the counts tell zero and gain
};

/// Whether one foot's counts mean no more than the momentum observer's force f:
/// raw = zero + gain f.
///
/// zero is the mean reading in the air, gain the mean of raw − zero over the mean of f on the
/// ground. Either only ages in its own phase, so that standing for long does not forget the zero,
/// and follows slow drift. A jump upwards shows at once, on the ground too, where the word
/// "contact" is still right: its force less the tolerance is summed up. Counts that mean less are
/// not judged: either contact is still told right, or it is not, which SensorHealth sees; and the
/// observer of a nearly stretched leg may find 40 N too much.
/// The sensor's dead band is left to gain and tolerance.
/// Source: [Page1954], cumulative sum; differs: the deviation is capped.
class ForceMatch {
 public:
  ForceMatch(const ForceMatchParams& params, double step_s) noexcept
      : params_(params), step_s_(step_s) {}

  /// @returns false from when the impulse is reached, while the excess lasts.
  bool Update(const ForceMatchInput& in) noexcept;

 private:
  /// Exponential mean that begins as the plain one.
  struct Mean {
    double value = 0.0, time_s = 0.0;
    void Add(double sample, double step_s, double constant_s) noexcept;
  };
  void Learn(const ForceMatchInput& in) noexcept;
  [[nodiscard]] bool CanJudge(const ForceMatchInput& in) const noexcept;

  ForceMatchParams params_;
  double step_s_;
  Mean zero_counts_, ground_counts_, ground_force_N_;  // in the air; over zero; the observer's
  double excess_Ns_ = 0.0;                             // by the counts
};

}  // namespace scoria::controller
