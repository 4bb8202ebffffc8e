// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/math/types.h"

namespace scoria::analysis {

/// RMS height difference of footholds a lag apart: what a walk tells of the ground's deviogram
/// nu(lag). The plane through the footholds of each stretch of two metres is removed, so that a
/// hill is not taken for roughness. Feet choose their ground, and the estimate drifts meanwhile:
/// pairs are of footholds that followed each other within kPairs.
class FootholdRoughness {
 public:
  static constexpr std::size_t kPairs = 24;
  /// Lags count if they lie within a factor of this.
  static constexpr double kTolerance = 1.3;
  static constexpr double kStretch_m = 2.0;

  /// @param p_WF_m  where a foot stood, in the estimator's frame.
  void Add(const Vec3& p_WF_m) { footholds_.push_back(p_WF_m); }

  /// The way begins anew: what follows makes no pairs with what was before.
  void Break() { breaks_.push_back(footholds_.size()); }

  /// @returns m; none if fewer than 30 pairs are so far apart.
  [[nodiscard]] std::optional<double> Nu_m(double lag_m) const;

  /// Footholds of the way, cut where it has gone kStretch_m, and at breaks. Borrowed.
  [[nodiscard]] std::vector<std::span<const Vec3>> Stretches() const;

  [[nodiscard]] std::size_t count() const noexcept { return footholds_.size(); }

 private:
  std::vector<Vec3> footholds_;
  std::vector<std::size_t> breaks_;
};

}  // namespace scoria::analysis
