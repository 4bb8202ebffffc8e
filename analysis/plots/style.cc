// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/style.h"

#include <array>

#include <fmt/format.h>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {
namespace {

constexpr std::size_t kDistinct = 6;  // colours, and open point types

}  // namespace

const char* PaletteColour(std::size_t index) noexcept {
  constexpr std::array<const char*, kDistinct> kColours = {Palette::kBlue,   Palette::kVermilion,
                                                           Palette::kGreen,  Palette::kPurple,
                                                           Palette::kOrange, Palette::kSky};
  return kColours[index % kDistinct];
}

ArmStyle StyleOfArm(std::size_t index) noexcept {
  constexpr int kFirst = 4;  // an open square; every second point type from there on is open
  return {PaletteColour(index), kFirst + 2 * static_cast<int>(index % kDistinct)};
}

std::string ArmTicks(const std::vector<std::string>& arms) {
  std::string ticks;
  for (std::size_t a = 0; a < arms.size(); ++a)
    ticks += fmt::format("{}'{}' {}", a > 0 ? ", " : "", Escape(arms[a]), a);
  return ticks;
}

}  // namespace scoria::analysis
