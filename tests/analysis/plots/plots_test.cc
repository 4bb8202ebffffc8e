// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "analysis/plots/bar_plot.h"
#include "analysis/plots/course_plot.h"
#include "analysis/plots/distribution_plot.h"
#include "analysis/plots/fit_plot.h"
#include "analysis/plots/rate_plot.h"
#include "analysis/plots/response_plot.h"
#include "analysis/plots/roc_plot.h"
#include "analysis/plots/style.h"
#include "analysis/plots/survival_plot.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

/// Its gnuplot script, after gnuplot has drawn it.
std::string Drawn(const Figure& figure) {
  const test::TemporaryFolder folder;
  figure.Render(folder.path());
  return core::ReadText(folder.path() / (figure.name() + ".gp"));
}

TEST(Style, ArmsDifferUntilColoursRepeat) {
  for (std::size_t a = 1; a < 6; ++a) {
    EXPECT_STRNE(StyleOfArm(a).colour, StyleOfArm(a - 1).colour);
    EXPECT_NE(StyleOfArm(a).open_symbol, StyleOfArm(a - 1).open_symbol);
  }
  EXPECT_STREQ(StyleOfArm(6).colour, StyleOfArm(0).colour);
  EXPECT_EQ(ArmTicks({"a", "it's"}), "'a' 0, 'it\\047s{}' 1");
}

TEST(RatePlot, ArmWithoutEventsIsATriangleAtItsBound) {
  RatePlot plot{"rates", "t", "x", "y", {1.0, 2.0}, {}};
  plot.series = {{"a", {EstimateRate(5, 100.0), std::nullopt}},
                 {"b", {EstimateRate(0, 100.0), std::nullopt}}};
  const std::string script = Drawn(DrawRates(plot));
  EXPECT_NE(script.find("$a0 << EOD\n0.97 0.05 "), std::string::npos);
  EXPECT_NE(script.find("$a1n << EOD\n1.03 0.0368887945 \nEOD"), std::string::npos);
  EXPECT_EQ(script.find("nothing walked"), std::string::npos);
}

TEST(RatePlot, SaysThatNothingWasWalked) {
  const RatePlot plot{"rates", "t", "x", "y", {1.0, 2.0}, {{"a", {std::nullopt, std::nullopt}}}};
  EXPECT_NE(Drawn(DrawRates(plot)).find("nothing walked"), std::string::npos);
}

TEST(FitPlot, LeavesOutArmsWithoutPointsAndKeepsColours) {
  FitPlot plot{"fits", "t", "x", "y", {}};
  plot.series.resize(3);
  plot.series[1] = {"points alone", {{0.3, 1.0}, {0.4, 1.1}}, {}};
  CurveFit fit;
  fit.valid = true;
  fit.r2 = 0.5;
  fit.x = {0.3, 0.4};
  fit.y = {1.0, 2.0};
  plot.series[2] = {"curve", {{0.3, 1.0}}, fit};
  const std::string script = Drawn(DrawFits(plot));
  EXPECT_EQ(script.find("$p0"), std::string::npos);
  EXPECT_NE(script.find("lc rgb '#d55e00' t 'points alone'"), std::string::npos);
  EXPECT_NE(script.find("lc rgb '#009e73' t 'curve (r^2 = 0.50, n = 1)'"), std::string::npos);
}

TEST(BarPlot, BarsOfAnArmStandSideBySide) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const BarPlot plot{"bars",
                     "t",
                     {"a", "b"},
                     {{"one", {{"", {1, none}}}}, {"two", {{"m", {1, 2}}, {"p", {3, 4}}}}}};
  const std::string script = Drawn(DrawBars(plot));
  EXPECT_NE(script.find("$p0 << EOD\n0 1 \n1 NaN \nEOD"), std::string::npos);
  EXPECT_NE(script.find("$p1 u ($1-0.175):2 w boxes lc rgb '#0072b2' t 'm', $p1 u ($1+0.175):3"),
            std::string::npos);
}

TEST(CoursePlot, GapIsNoLineAndStatesHaveTheirHeight) {
  CoursePlot plot;
  plot.name = "course";
  plot.time_s = {0.0, 0.5, 5.0};
  plot.panels = {
      {.y_label = "y",
       .bands = {{"band", {1, 1, 1}, {2, 2, 2}}},
       .lines = {{"line", {1.0, 2.0, 3.0}}}},
      {.y_label = "s", .states = {{"top", {true, false, true}}, {"bottom", {false, true, true}}}}};
  plot.marks_s = {0.25};
  plot.stretches_s = {{0.0, 0.5}, {0.5, 1.0}};
  const std::string script = Drawn(DrawCourse(plot));
  EXPECT_NE(script.find("$d << EOD\n0 1 2 1 2 NaN \n0.5 1 2 2 NaN 1 \nNaN NaN NaN NaN NaN NaN \n"
                        "5 1 2 3 2 1 \nEOD"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("set ytics ('top' 2, 'bottom' 1); plot $d u 1:5 w l"), std::string::npos);
  EXPECT_NE(script.find("arrow 1 from 0.25,graph 0"), std::string::npos);
  EXPECT_NE(script.find("rect from 0.5,graph 0 to 1"), std::string::npos);
}

TEST(CoursePlot, DrawsNoMoreThanALineCanShow) {
  CoursePlot plot;
  plot.name = "course";
  for (int i = 0; i < 20000; ++i) plot.time_s.push_back(0.01 * i);
  plot.panels = {{.y_label = "y", .lines = {{"line", plot.time_s}}}};
  const std::string script = Drawn(DrawCourse(plot));
  const std::string data = script.substr(0, script.find("EOD\n", script.find("$d <<") + 10));
  EXPECT_LE(std::count(data.begin(), data.end(), '\n'), 4100);
}

TEST(SurvivalPlot, DrawsStepsBandsAndCensoredLengths) {
  const SurvivalPlot plot{
      "survival",
      "t",
      "x",
      "y",
      {{"none", {}},
       {"a", EstimateSurvival(std::vector<Lifetime>{{2, true}, {3, false}, {5, true}})}}};
  const std::string script = Drawn(DrawSurvival(plot));
  EXPECT_NE(script.find("$s1 << EOD\n0 1 1 1 \n2 1 1 1 \n2 0.666666667 "), std::string::npos)
      << script;
  EXPECT_NE(script.find("$s1c << EOD\n3 0.666666667 \nEOD"), std::string::npos);
  EXPECT_NE(script.find("lc rgb '#d55e00' t 'a', $s1c"), std::string::npos);
  EXPECT_EQ(script.find("$s0"), std::string::npos);
}

TEST(DistributionPlot, DrawsEveryWalkThinAndTheMeanThick) {
  const DistributionPlot plot{
      "d", "t", "x", {{"first", {{0, 1, 2}}}, {"second", {{0, 1, 4}, {0, 3, 8}}}}};
  const std::string script = Drawn(DrawDistributions(plot));
  EXPECT_NE(script.find("$w1_1 << EOD\n0 0 \n3 0.5 \n8 1 \nEOD"), std::string::npos) << script;
  EXPECT_NE(script.find("$m1 << EOD\n0 0 \n2 0.5 \n6 1 \nEOD"), std::string::npos);
  EXPECT_NE(script.find("set xrange [0:3]"), std::string::npos) << "the middle is within 99 %";
  EXPECT_NE(script.find("$m1 u 1:2 w l lw 2.5 lc rgb '#d55e00' t 'second'"), std::string::npos);
}

TEST(ResponsePlot, HasAPanelForEachFactor) {
  const ResponseSeries none{"none", {}, {}}, a{"a", {{1, 2}, {10, 3}}, {{5, 2.5}}};
  const ResponsePlot plot{
      "response", "t", "y", {{"speed", false, {none, a}}, {"slope", true, {none, a}}}};
  const std::string script = Drawn(DrawResponses(plot));
  EXPECT_NE(script.find("layout 1,2"), std::string::npos);
  EXPECT_NE(script.find("set xlabel 'speed'; unset logscale x; plot $r0_1p"), std::string::npos);
  EXPECT_NE(script.find("set xlabel 'slope'; set logscale x; plot $r1_1p"), std::string::npos);
  EXPECT_NE(script.find("$r1_1m << EOD\n5 2.5 \nEOD"), std::string::npos);
  EXPECT_EQ(script.find("_0p"), std::string::npos);
}

TEST(RocPlot, NamesTheAreaAndMarksWhereADetectorIsUsed) {
  RocPlot plot{"roc", "t", "x", "y", {}};
  plot.series = {
      {{}, {}},
      {{{"sensor", {{0, 0}, {0.1, 0.9}, {1, 1}}, 0.9, true}}, {{{0.1, 0.9}, Symbol::kDiamond}}}};
  const std::string script = Drawn(DrawRoc(plot));
  EXPECT_NE(script.find("dt 2 lc rgb '#d55e00' t 'sensor (AUC 0.9000)'"), std::string::npos);
  EXPECT_NE(script.find("pt 13 ps 1 lc rgb '#d55e00' notitle\n"), std::string::npos);
}

}  // namespace
}  // namespace scoria::analysis
