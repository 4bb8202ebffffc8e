// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/document.h"

#include <gtest/gtest.h>

#include "analysis/report/html.h"
#include "analysis/report/plain_text.h"
#include "analysis/report/table.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

CaptionedFigure Drawing(const std::string& name, const std::string& command) {
  Figure figure(name, "A <line>");
  figure.Line(command);
  return {std::move(figure), "Its caption"};
}

/// Every kind of block.
Document Sample() {
  Document d;
  d.title = "a & b";
  d.head.text = {Paragraph{"First"}, Heading{"Who"}, BulletList{{"x < y"}}};
  d.head.below = {Note{"Small print"}};
  d.chapters = {
      {"one",
       "Chapter <1>",
       {Table{{"arm", "µs"}, {{"a", "1"}, {"longer", "–"}}}, VideoLink{"../a b.mp4", "walk"}}},
      {"two", "Chapter 2", {Drawing("good", "plot x"), Drawing("bad", "plot nonsense(x)")}}};
  d.not_shown = {"Chapter 3, because it rains."};
  return d;
}

TEST(Document, FigureThatGnuplotRefusesHasItsProblem) {
  const test::TemporaryFolder folder;
  const Document d = DrawFigures(Sample(), folder.path());
  const auto& good = std::get<CaptionedFigure>(d.chapters[1].blocks[0]);
  const auto& bad = std::get<CaptionedFigure>(d.chapters[1].blocks[1]);
  ASSERT_TRUE(good.svg);
  EXPECT_NE(good.svg->find("<svg"), std::string::npos);
  EXPECT_FALSE(bad.svg);
  EXPECT_EQ(MissingFigure(bad).find("A <line>: this figure could not be drawn: "), 0u);
  EXPECT_NE(bad.problem.find("undefined function"), std::string::npos) << bad.problem;
}

TEST(Html, ChaptersAreAnchorsThatTheHeadLinksTo) {
  const test::TemporaryFolder folder;
  const std::string html = ToHtml(DrawFigures(Sample(), folder.path()));
  for (const char* part :
       {"<h1>a &amp; b</h1>", "<li>x &lt; y</li>", "<a href=\"#one\">Chapter &lt;1&gt;</a>",
        "<h2 id=\"one\">Chapter &lt;1&gt;</h2>", "<a href=\"#not_shown\">Not shown</a>",
        "<h2 id=\"not_shown\">Not shown</h2>\n<ul>\n<li>Chapter 3, because it rains.</li>",
        "<td>longer</td><td>–</td>", "src=\"../a%20b.mp4\"", "aria-label=\"A &lt;line&gt;\"",
        "<p>A &lt;line&gt;: this figure could not be drawn: "}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_LT(html.find("<p class=\"note\">Small print</p>"), html.find("id=\"one\""));
}

TEST(Html, EscapesText) { EXPECT_EQ(EscapeHtml("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;"); }

TEST(PlainText, HoldsAllButThePictures) {
  const test::TemporaryFolder folder;
  Document d = Sample();
  d.head.picture = ReportPicture{"\xff", "The first fall"};
  d.chapters[1].blocks.pop_back();
  EXPECT_EQ(ToPlainText(DrawFigures(std::move(d), folder.path())),
            "a & b\n=====\n\nFirst\n\nWho\n---\n\n- x < y\n\nThe first fall\n\nSmall print\n\n"
            "Chapter <1>\n-----------\n\n"
            "arm     µs\n"
            "a       1\n"
            "longer  –\n\n"
            "[../a b.mp4] walk\n\n"
            "Chapter 2\n---------\n\n"
            "[figures/good.svg] A <line>. Its caption\n\n"
            "Not shown\n---------\n\n"
            "- Chapter 3, because it rains.\n");
}

TEST(Table, BeginsWithPointAndArm) {
  struct Line {
    std::string arm;
    std::vector<std::string> point;
    double value = 0.0;
  };
  const std::vector<Column<Line>> columns = {
      {"value [m]", [](const Line& l) { return NumberText(l.value, 1); }}};
  const Table t = PointTable({{"k", "speed", {"0.3", "0.6"}, ""}},
                             std::vector<Line>{{"a", {"0.3"}, 1.25}, {"b", {"0.6"}, NAN}}, columns);
  EXPECT_EQ(t.header, (std::vector<std::string>{"speed", "arm", "value [m]"}));
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.rows[0], (std::vector<std::string>{"0.3", "a", "1.2"}));
  EXPECT_EQ(t.rows[1], (std::vector<std::string>{"0.6", "b", "–"}));
}

TEST(Table, NothingIsADash) {
  EXPECT_EQ(NumberText(When(false, 1.0), 2), "–");
  EXPECT_EQ(NumberText(When(true, 1.0), 2), "1.00");
  EXPECT_EQ(ShareText(1, 4, 1), "25.0");
  EXPECT_EQ(ShareText(0, 0, 1), "–");
}

}  // namespace
}  // namespace scoria::analysis
