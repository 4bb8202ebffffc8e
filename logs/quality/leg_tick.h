// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/robot/whole_body.h"
#include "logs/quality/leg_load.h"
#include "logs/quality/stance_by_torque.h"
#include "logs/quality/statistics.h"
#include "logs/quality/tick.h"

namespace scoria::logs {

/// What physics wants of a foot that bears load: it pushes the robot up, stays on the ground while
/// the trunk moves over it, and lies in reach below the trunk, beside the other feet.
struct FootMotion {
  Vec3 p_BF = Vec3::Zero();
  Vec3 v_B = Vec3::Zero();  // of the trunk's origin, in B, if the foot stays where it is
  std::optional<Vec3> f_B;  // the ground's force on it, by its torques
};

/// @param w_WB_B  the rate of the trunk.
[[nodiscard]] FootMotion CalcFootMotion(const core::LegDescription& leg, const Vec3& q,
                                        const Vec3& qd, const Vec3& tau, const Vec3& w_WB_B);

/// The legs as they are read, with what is known of the trunk.
struct LegTick {
  LegArray<Vec3> q = ZeroPerLeg(), qd = ZeroPerLeg(), tau = ZeroPerLeg();
  LegArray<bool> loaded;
  int num_loaded = 0;
  Vec3 w_WB_B = Vec3::Zero();
  Vec3 up_B = Vec3::UnitZ();
  std::optional<Vec3> v_WB_B = std::nullopt;  // of the trunk, by truth or estimate
};

/// The loaded feet of other legs.
struct OtherFeet {
  Vec3 v_B = Vec3::Zero();  // mean motion of the trunk by them
  double height = 0.0;      // mean, along up
  double height_B = 0.0;    // along z of the trunk
  int count = 0;
  void Add(const FootMotion& foot, const Vec3& up_B);
};

/// How far the speeds of loaded feet, taken right, are from each other: they roll and slip. And
/// whether they lie beside each other: legs that are swapped on level ground look like a slope.
struct CostSizes {
  double floor_mps = 0.1, share = 0.15;
  bool has_heights = true;
};

/// What a leg is from what a loaded one should be: a sum of up to six costs (see RobustCost).
[[nodiscard]] double CalcCost(const core::LegDescription& leg, const Vec3& q,
                              const FootMotion& foot, const LegTick& tick, const OtherFeet& others,
                              const CostSizes& sizes);

/// Makes them of ticks as they come.
class LegTickMaker {
 public:
  /// @param robot  borrowed; not null.
  explicit LegTickMaker(const core::RobotDescription& robot, double gravity_mps2);

  /// Nothing where joints, torques or the rate of the trunk are not known, and where the trunk is
  /// far from equilibrium: forces of the feet do not hold it up then.
  [[nodiscard]] std::optional<LegTick> Make(const Tick& tick);

  /// Whether that is so for much of the time: of a gait with flight, statics tell nothing.
  [[nodiscard]] bool IsFarFromEquilibrium() const noexcept {
    constexpr double kMostShare = 0.25;
    return static_cast<double>(far_) > kMostShare * static_cast<double>(specific_force_.count());
  }

 private:
  StanceByTorque stance_;
  Moments specific_force_;  // sizes, in whatever unit it is read
  std::uint64_t far_ = 0;
};

}  // namespace scoria::logs
