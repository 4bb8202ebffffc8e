// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace scoria::analysis {

/// Counts of two arms on the same terrain.
struct PairedCounts {
  long events_a = 0, events_b = 0;
  double exposure_a = 0.0, exposure_b = 0.0;

  PairedCounts& operator+=(const PairedCounts& other) noexcept {
    events_a += other.events_a;
    events_b += other.events_b;
    exposure_a += other.exposure_a;
    exposure_b += other.exposure_b;
    return *this;
  }
};

/// Counts of two arms on the same terrain, in each of two settings.
struct CountsInTwoSettings {
  PairedCounts first, second;

  CountsInTwoSettings& operator+=(const CountsInTwoSettings& other) noexcept {
    first += other.first;
    second += other.second;
    return *this;
  }
};

/// Events of a beyond its share of all, if the rates are equal: swapping the arms changes its sign
/// alone. @pre an exposure > 0.
[[nodiscard]] inline double ExcessOfA(const PairedCounts& c) noexcept {
  return (static_cast<double>(c.events_a) * c.exposure_b -
          static_cast<double>(c.events_b) * c.exposure_a) /
         (c.exposure_a + c.exposure_b);
}

/// Does one arm's share of the falls differ between terrains more than chance allows? Terrains that
/// are harder for both arms do not matter: the comparison is paired.
struct Dispersion {
  double index = 1.0;    // chi-squared over degrees of freedom; 1 when only chance is at work
  double p_value = 1.0;  // of "only chance", one-sided
};
/// Source: [Haldane1940], whose mean of chi-squared for small counts the index is relative to.
[[nodiscard]] Dispersion CheckShares(std::span<const PairedCounts> terrains);

}  // namespace scoria::analysis
