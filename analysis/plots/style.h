// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scoria::analysis {

/// Colours that the common colour-vision deficiencies tell apart ([Okabe2008]), and greys.
struct Palette {
  static constexpr const char* kBlue = "#0072b2";
  static constexpr const char* kVermilion = "#d55e00";
  static constexpr const char* kGreen = "#009e73";
  static constexpr const char* kPurple = "#cc79a7";
  static constexpr const char* kOrange = "#e69f00";
  static constexpr const char* kSky = "#56b4e9";
  static constexpr const char* kYellow = "#f0e442";
  static constexpr const char* kBlack = "#000000";
  static constexpr const char* kDarkGrey = "#444444";
  static constexpr const char* kGrey = "#d2d2d2";
  static constexpr const char* kLightGrey = "#e4e4e4";
};

/// Colours of things that stand side by side; they repeat after the sixth.
[[nodiscard]] const char* PaletteColour(std::size_t index) noexcept;

/// gnuplot's point types.
enum class Symbol { kSquare = 5, kDisc = 7, kTriangle = 9, kTriangleDown = 11, kDiamond = 13 };

/// How an arm is drawn, in every figure.
struct ArmStyle {
  const char* colour = Palette::kBlack;
  int open_symbol = 6;  // gnuplot's point type
};
/// @param index of the arm in its campaign; styles repeat after the sixth.
[[nodiscard]] ArmStyle StyleOfArm(std::size_t index) noexcept;

/// The ticks of an axis with an arm at each whole number: "'ags' 0, 'sgs' 1".
[[nodiscard]] std::string ArmTicks(const std::vector<std::string>& arms);

}  // namespace scoria::analysis
