// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/math/types.h"
#include "core/robot/legs.h"

namespace scoria::analysis {

/// How well an estimate of the trunk's motion agrees with its own feet: what can be said of it
/// where there is no truth. All in the estimator's frame.
struct EstimateConsistency {
  std::uint64_t stance_samples = 0;
  double stance_speed_rms_mps = 0.0;  // of the points at which standing feet touch the ground
  std::uint64_t footholds = 0;
  double plane_rms_m = 0.0;     // of the footholds over the plane through those of a segment
  double path_m = 0.0;          // in chords of 0.1 m
  double closure_m = 0.0;       // from the first place to the last, of the longest segment
  double closure_path_m = 0.0;  // the path between them
};

/// One instant of the estimate.
struct FeetInstant {
  Vec3 p_WB = Vec3::Zero();
  LegArray<Vec3> p_WF = ZeroPerLeg();  // m, sphere centres
  /// m/s, of the point of each sphere that touches the ground.
  LegArray<Vec3> v_WContact = ZeroPerLeg();
  LegArray<bool> contact;
};

/// Accumulates instants; what it keeps does not grow with them.
class ConsistencyAccumulator {
 public:
  /// @param segment  instants of different segments are not one path.
  void Add(const FeetInstant& now, std::uint32_t segment);
  /// Ends the open segment.
  [[nodiscard]] EstimateConsistency Finish();

 private:
  /// Sums for the least-squares plane z = a + b x + c y.
  class Plane {
   public:
    void Add(const Vec3& p) noexcept;
    /// Sum of the squared heights over the plane; 0 for fewer than four points.
    [[nodiscard]] double SquaredResidual() const;
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

   private:
    std::optional<Vec3> origin_;
    Mat3 A_ = Mat3::Zero();
    Vec3 b_ = Vec3::Zero();
    double zz_ = 0.0;
    std::uint64_t count_ = 0;
  };
  struct Stance {
    std::uint64_t count = 0;
    Vec3 sum = Vec3::Zero();
  };
  void EndStance(Leg leg);
  void EndSegment();

  std::optional<std::uint32_t> segment_;
  Vec3 start_ = Vec3::Zero(), chord_ = Vec3::Zero(), last_ = Vec3::Zero();
  double segment_path_m_ = 0.0, sum_speed_m2ps2_ = 0.0, sum_plane_m2_ = 0.0;
  LegArray<Stance> stance_;
  Plane plane_;
  EstimateConsistency out_;
};

}  // namespace scoria::analysis
