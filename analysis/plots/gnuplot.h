// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace scoria::analysis {

/// Where a row of a figure has no value.
inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// One figure as a gnuplot script with its data inside. Render writes NAME.gp, .svg, .png and .pdf
/// into the folder, so that a reader can restyle the figure without scoria.
class Figure {
 public:
  Figure(std::string name, std::string title, int width_px = 900, int height_px = 560);

  /// A data block, referred to as $name in the script. Rows are lists of columns; NaN is a gap.
  void Data(const std::string& name, const std::vector<std::vector<double>>& rows);
  /// One line of gnuplot script.
  void Line(const std::string& text) { script_ += text + "\n"; }

  /// Nothing of an older figure of that name remains, and no file is half written.
  /// Errors: std::runtime_error with gnuplot's words; core::FileError.
  void Render(const std::filesystem::path& folder) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& title() const { return title_; }

 private:
  [[nodiscard]] std::string Script() const;

  std::string name_, title_, data_, script_;
  int width_px_, height_px_;
};

/// Any text for a gnuplot string in single quotes, a title or the label of a tick, which enhanced
/// mode shows as it stands; what is too long for a figure is cut.
[[nodiscard]] std::string Escape(const std::string& text);

}  // namespace scoria::analysis
