// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/gnuplot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

/// Names that mean something to gnuplot, HTML, a shell or a file system.
const std::vector<std::string> kNames = {"50 % \"x\"\\y",
                                         "duty 50%",
                                         "100 %s %d %g",
                                         "back\\slash",
                                         "<b>bold</b> & co",
                                         "$(x) `x` $1",
                                         "a_b^c{d}@e&f~g",
                                         "it's",
                                         "a/b",
                                         ".hidden",
                                         "# no comment",
                                         "two\nlines\tand\x01more",
                                         "Rückweg 歩行 𝛑",
                                         "not \xfc UTF-8",
                                         "\\",
                                         "'",
                                         "%",
                                         "",
                                         std::string(3000, 'w')};

TEST(Gnuplot, DrawsAnyName) {
  const test::TemporaryFolder folder;
  Figure figure("names", "names");
  std::string ticks, plot;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    ticks += fmt::format("{}'{}' {}", i > 0 ? ", " : "", Escape(kNames[i]), i);
    plot += fmt::format("{}$d u 1:($2+{}) w l t '{}'", i > 0 ? ", " : "", i, Escape(kNames[i]));
    figure.Line(
        fmt::format("set title '{}'; set xlabel '{}'", Escape(kNames[i]), Escape(kNames[i])));
  }
  figure.Data("d", {{0.0, 1.0}, {1.0, 2.0}});
  figure.Line("set xtics (" + ticks + "); set xrange [-1:20]");
  figure.Line("plot " + plot);
  figure.Render(folder.path());
  const std::string svg = core::ReadText(folder.path() / "names.svg");
  for (const char* seen : {"50 % \"x\"\\y", "duty 50%", "100 %s %d %g", "back\\slash",
                           "&lt;b>bold&lt;/b> &amp; co", "$(x) `x` $1", "a_b^c{d}@e&amp;f~g",
                           "it's", "# no comment", "Rückweg 歩行 𝛑", "not \ufffd UTF-8"}) {
    EXPECT_NE(svg.find(seen), std::string::npos) << seen;
    std::size_t times = 0;
    for (std::size_t at = 0; (at = svg.find(seen, at)) != std::string::npos; ++at) ++times;
    EXPECT_GE(times, 2u) << seen << ": as a tick's label and in the key";
  }
}

/// gnuplot's own plain text is the oracle.
TEST(Gnuplot, EscapedTextLooksThePlainWayInPixels) {
  const test::TemporaryFolder folder;
  const auto draw = [&](const std::string& name, const std::string& label) {
    Figure figure(name, name);
    figure.Line("unset xtics; unset ytics; unset border; set margins 5,5,5,5");
    figure.Line("set label 1 " + label);
    figure.Line("plot [-1:1][-1:1] NaN notitle");
    figure.Render(folder.path());
    return core::ReadText(folder.path() / (name + ".png"));
  };
  EXPECT_EQ(draw("escaped", "'" + Escape("a_b 50%") + "' at 0,0"),
            draw("plain", "\"a_b 50%\" at 0,0 noenhanced"));
}

TEST(Gnuplot, RefusedFigureSaysWhyAndLeavesNoOldOne) {
  const test::TemporaryFolder folder;
  Figure good("f", "f");
  good.Line("plot [0:1] x");
  good.Render(folder.path());
  EXPECT_TRUE(fs::exists(folder.path() / "f.svg"));
  Figure bad("f", "f");
  bad.Line("plot [0:1] nonsense(x)");
  try {
    bad.Render(folder.path());
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("f.gp: gnuplot failed: "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("undefined function"), std::string::npos) << e.what();
  }
  for (const char* name : {"f.svg", "f.png", "f.pdf", "f.draft"})
    EXPECT_FALSE(fs::exists(folder.path() / name)) << name;
}

TEST(Gnuplot, NumbersThatAreNoneAreGaps) {
  const test::TemporaryFolder folder;
  Figure figure("f", "f");
  figure.Data("d", {{0.0, 1.0}, {INFINITY, -INFINITY}, {NAN, 2.0}, {1.0, 2.0}});
  figure.Line("plot $d u 1:2 w l");
  EXPECT_NO_THROW(figure.Render(folder.path()));
}

}  // namespace
}  // namespace scoria::analysis
