// SPDX-License-Identifier: BSD-3-Clause
#include "core/similarity.h"

#include <cmath>

#include <fmt/format.h>

namespace scoria::core {
namespace {

double Ratio(double value, double reference) noexcept {
  constexpr double kSame = 1e-3;
  const double ratio = value / reference;
  return std::abs(ratio - 1.0) < kSame ? 1.0 : ratio;
}

double LengthExponent(const Dimension& d) noexcept { return d.length + 0.5 * d.time; }

std::string PowerText(const char* symbol, double exponent) {
  if (exponent == 0.0) return "";
  return exponent == 1.0 ? symbol : fmt::format("{}^{}", symbol, exponent);
}

}  // namespace

Similarity Similarity::Of(double mass_kg, double leg_m) noexcept {
  constexpr double kGo2_kg = 15.019, kGo2Leg_m = 0.426;
  return {Ratio(mass_kg, kGo2_kg), Ratio(leg_m, kGo2Leg_m)};
}

double Similarity::Factor(const Dimension& dimension) const noexcept {
  if (IsReference()) return 1.0;
  return std::pow(mass, dimension.mass) * std::pow(length, LengthExponent(dimension));
}

std::string ScaleText(const Dimension& dimension) {
  const std::string m = PowerText("m", dimension.mass),
                    l = PowerText("L", LengthExponent(dimension));
  return m.empty() || l.empty() ? m + l : m + " " + l;
}

}  // namespace scoria::core
