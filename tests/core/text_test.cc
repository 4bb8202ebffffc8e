// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"

#include <gtest/gtest.h>

#include "core/file_kind.h"

namespace scoria::core {
namespace {

using namespace std::string_view_literals;

TEST(Text, InvalidUtf8IsFoundAtItsByte) {
  EXPECT_FALSE(FindInvalidUtf8("plain"));
  EXPECT_FALSE(
      FindInvalidUtf8("R\xc3\xbc"
                      "ckweg \xf0\x9f\x8c\x8b"));
  EXPECT_EQ(FindInvalidUtf8("R\xfc"
                            "ckweg"),
            1u);                                   // Latin-1
  EXPECT_EQ(FindInvalidUtf8("cut \xe2\x82"), 4u);  // a character that ends too early
  EXPECT_EQ(FindInvalidUtf8("\xed\xa0\x80"), 0u);  // a surrogate
  EXPECT_EQ(FindInvalidUtf8("over\xc0\xaflong"), 4u);
}

TEST(Text, PlaceCountsFromOne) {
  const std::string_view text = "ab\ncd\n\ne";
  EXPECT_EQ(PlaceOf(text, 0).line, 1);
  EXPECT_EQ(PlaceOf(text, 4).line, 2);
  EXPECT_EQ(PlaceOf(text, 4).column, 2);
  EXPECT_EQ(PlaceOf(text, 7).line, 4);
  EXPECT_EQ(PlaceOf(text, 7).column, 1);
}

TEST(Text, ShownIsShortValidAndOnOneLine) {
  EXPECT_EQ(Shown("as it is"), "as it is");
  EXPECT_EQ(Shown("two\nlines\tof\x01text"), "two lines of text");
  EXPECT_EQ(Shown("R\xfc"
                  "ckweg"),
            "R\\xFCckweg");
  EXPECT_EQ(Shown("0123456789abc", 10), "0123456789... (13 bytes)");
  EXPECT_EQ(Shown("0123456789", 10), "0123456789");
  // No character is cut in two.
  for (std::size_t longest = 1; longest < 12; ++longest)
    EXPECT_FALSE(FindInvalidUtf8(Shown("\xc3\xbc\xe2\x82\xac\xf0\x9f\x8c\x8b\xc3\xbc", longest)));
}

TEST(Text, XmlCommentsBecomeBlanksInPlace) {
  EXPECT_EQ(BlankXmlComments("<a><!-- x\ny --><b/></a>"), "<a>      \n     <b/></a>");
  EXPECT_EQ(BlankXmlComments("a<!-- never closed"), "a                 ");
  EXPECT_EQ(BlankXmlComments("none"), "none");
}

TEST(FileKind, IsKnownByItsContent) {
  const auto name = [](std::string_view head) { return KindOfContent(head).name; };
  EXPECT_EQ(name("\x89PNG\r\n\x1a\n"), "a PNG image");
  EXPECT_EQ(name("\x89MCAP0\r\n"), "an MCAP log");
  EXPECT_EQ(name("SQLite format 3\0"sv), "an SQLite database");
  EXPECT_EQ(name("#ROSBAG V2.0\n"), "a ROS 1 bag");
  EXPECT_EQ(name("\xff\xd8\xff\xe0"), "a JPEG image");
  EXPECT_EQ(name("II*\0\x08\0\0\0"sv), "a TIFF image");
  EXPECT_EQ(name("\x7f"
                 "ELF\x02"),
            "a program");
  EXPECT_EQ(name("\x1f\x8b\x08"), "a gzip archive");
  EXPECT_EQ(name("PK\x03\x04"), "a zip archive");
  EXPECT_EQ(name("\xff\xfe"
                 "n\0a\0"sv),
            "UTF-16 text");
  EXPECT_EQ(name("\0\0\0\x20"
                 "ftypisom"sv),
            "an MP4 video");
  EXPECT_EQ(name("abc\0def"sv), "a binary file");
  EXPECT_EQ(name("version https://git-lfs.github.com/spec/v1\noid"), "a Git LFS pointer");
  EXPECT_EQ(name("<?xml version=\"1.0\"?>\n<!-- made by hand -->\n<robot name=\"a\">"), "a URDF");
  EXPECT_EQ(name("<robot name=\"a\"><mass value=\"${m}\"/>"), "a xacro");
  EXPECT_EQ(name("<robot name=\"a\"><xacro:leg/>"), "a xacro");
  EXPECT_EQ(name("<robot name=\"a\"><!-- ${m} <xacro:leg/> --><link/>"), "a URDF");
  EXPECT_EQ(name("<robot xmlns:xacro=\"http://ros.org/wiki/xacro\"><link/>"), "a URDF");
  EXPECT_EQ(name("<sdf version=\"1.6\">"), "an SDF model");
  EXPECT_EQ(name("<mujoco model=\"a\">"), "a MuJoCo model");
  EXPECT_EQ(name("<!DOCTYPE html>\n<html>"), "an HTML page");
  EXPECT_EQ(name("<?xml version=\"1.0\"?><kml>"), "an XML file");
  EXPECT_EQ(name("\xef\xbb\xbf\nNCOLS 16\n"), "an ESRI ASCII grid");
  EXPECT_EQ(name("solid body\nfacet"), "an STL mesh");
  for (const char* yaml : {"", "name: flat\n", "# comment\nname: a\n", "{name: a}", "ncols: 3\n"})
    EXPECT_EQ(name(yaml), "") << yaml;
}

TEST(FileKind, MessageNamesKindWishAndHint) {
  EXPECT_EQ(NotOfKind(KindOfContent("<robot name=\"${n}\">"), "a URDF"),
            "is a xacro, not a URDF (expand it: xacro IN > OUT.urdf)");
  EXPECT_EQ(NotOfKind(KindOfContent("%PDF-1.4"), "a YAML file"), "is a PDF, not a YAML file");
}

TEST(PrintableText, ReplacesWhatIsNotUtf8AndControls) {
  EXPECT_EQ(PrintableText("Rückweg 歩 𝛑"), "Rückweg 歩 𝛑");
  EXPECT_EQ(PrintableText("R\xfc"
                          "ck"),
            "R\ufffdck");
  EXPECT_EQ(PrintableText("\xc0\xaf"), "\ufffd\ufffd") << "overlong";
  EXPECT_EQ(PrintableText("\xed\xa0\x80"), "\ufffd\ufffd\ufffd") << "a surrogate";
  EXPECT_EQ(PrintableText("\xe2\x82"), "\ufffd\ufffd") << "cut";
  EXPECT_EQ(PrintableText("a\nb\x1b[0m"), "a b [0m");
}

}  // namespace
}  // namespace scoria::core
