// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/msg_parser.h"

#include <gtest/gtest.h>

#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::kLine;

MessageDefinition ParsedMsg(const std::string& text) {
  return ParseMsg(text, "pkg/msg/Type", "T.msg");
}

std::string MsgErrorOf(const std::string& text) {
  return test::ErrorOf<DefinitionError>([&] { ParsedMsg(text); });
}

FieldDefinition MsgFieldOf(const std::string& line) { return ParsedMsg(line).fields.at(0); }

TEST(MsgParser, ReadsScalarsArraysAndBounds) {
  EXPECT_EQ(MsgFieldOf("float64 x"),
            (FieldDefinition{"x", "float64", Multiplicity::kOne, 0, 0, ""}));
  EXPECT_EQ(MsgFieldOf("int8[3] x"),
            (FieldDefinition{"x", "int8", Multiplicity::kArray, 3, 0, ""}));
  EXPECT_EQ(MsgFieldOf("bool[] x"),
            (FieldDefinition{"x", "bool", Multiplicity::kSequence, 0, 0, ""}));
  EXPECT_EQ(MsgFieldOf("float64[<=3] x"),
            (FieldDefinition{"x", "float64", Multiplicity::kSequence, 3, 0, ""}));
  EXPECT_EQ(MsgFieldOf("string<=22 s"),
            (FieldDefinition{"s", "string", Multiplicity::kOne, 0, 22, ""}));
  EXPECT_EQ(MsgFieldOf("wstring<=5[<=10] s"),
            (FieldDefinition{"s", "wstring", Multiplicity::kSequence, 10, 5, ""}));
}

TEST(MsgParser, KeepsDefaultsAsWritten) {
  EXPECT_EQ(MsgFieldOf("string<=22 s \"Hello # world!\"  # comment").default_text,
            "\"Hello # world!\"");
  EXPECT_EQ(MsgFieldOf("float64[<=3] x [1.0, 2.0]").default_text, "[1.0, 2.0]");
  EXPECT_EQ(MsgFieldOf("string s 'Hello\\'#world!'").default_text, "'Hello\\'#world!'");
  EXPECT_EQ(MsgFieldOf("string s \"a=b\"").default_text, "\"a=b\"");
  EXPECT_EQ(MsgFieldOf("string s bare").default_text, "bare");
}

TEST(MsgParser, ReadsConstants) {
  const MessageDefinition m = ParsedMsg(
      "uint8 A=1\nuint8 B = 2\nstring NAME=\"a#b\"\nstring BARE= a b # c\nstring EMPTY=\n"
      "float32 X=-1.5 #c\n");
  EXPECT_TRUE(m.fields.empty());
  const std::vector<ConstantDefinition> expected = {
      {"uint8", "A", "1"},       {"uint8", "B", "2"},     {"string", "NAME", "a#b"},
      {"string", "BARE", "a b"}, {"string", "EMPTY", ""}, {"float32", "X", "-1.5"}};
  EXPECT_EQ(m.constants, expected);
}

TEST(MsgParser, ResolvesNamesOfMessages) {
  EXPECT_EQ(MsgFieldOf("Other x").type, "pkg/msg/Other");
  EXPECT_EQ(MsgFieldOf("geometry_msgs/Pose x").type, "geometry_msgs/msg/Pose");
  EXPECT_EQ(MsgFieldOf("geometry_msgs/msg/Pose[4] x").type, "geometry_msgs/msg/Pose");
  EXPECT_EQ(MsgFieldOf("Header header").type, "pkg/msg/Header");
}

TEST(MsgParser, ToleratesHowFilesAreWritten) {
  // Byte order mark, CRLF, tabs, comments in other scripts, no line end at the end.
  const MessageDefinition m = ParsedMsg(
      "\xEF\xBB\xBF# （rad）\r\nuint8\tgait_type\t\r\n\r\n  float32[3] position  \t # "
      "m（N*m）\r\nbool last");
  ASSERT_EQ(m.fields.size(), 3u);
  EXPECT_EQ(m.fields[0].name, "gait_type");
  EXPECT_EQ(m.fields[1].count, 3u);
  EXPECT_EQ(m.fields[2].name, "last");
  EXPECT_TRUE(ParsedMsg("").fields.empty());
}

TEST(MsgParser, AFieldMayBeCalledLikeAType) {
  EXPECT_EQ(MsgFieldOf("uint32 float64").name, "float64");
  EXPECT_EQ(MsgFieldOf("Duration Duration").type, "pkg/msg/Duration");
}

TEST(MsgParser, ErrorsNameLineTextAndRule) {
  EXPECT_EQ(MsgErrorOf("bool a\nfloat64"),
            "T.msg:2: \"float64\": a type is followed by the name of a field");
  EXPECT_EQ(MsgErrorOf("float64 2a"), "T.msg:1: \"float64 2a\": \"2a\" is not a name");
  EXPECT_EQ(MsgErrorOf("float64[x] a"),
            "T.msg:1: \"float64[x] a\": \"x\" is not a length (1 to 4294967295)");
  EXPECT_EQ(MsgErrorOf("float64[0] a"),
            "T.msg:1: \"float64[0] a\": \"0\" is not a length (1 to 4294967295)");
  EXPECT_EQ(MsgErrorOf("float64] a"), "T.msg:1: \"float64] a\": \"]\" without \"[\"");
  EXPECT_EQ(MsgErrorOf("int8<=3 a"),
            "T.msg:1: \"int8<=3 a\": \"<=N\" bounds a string or an array \"[<=N]\"");
  EXPECT_EQ(MsgErrorOf("a/b/c/d x"), "T.msg:1: \"a/b/c/d x\": \"a/b/c/d\" is not a type");
  EXPECT_EQ(MsgErrorOf("int8 A ="), "T.msg:1: \"int8 A =\": a constant has a value");
  EXPECT_EQ(MsgErrorOf("int8[2] A=1"),
            "T.msg:1: \"int8[2] A=1\": a constant is one number, bool or string");
  EXPECT_EQ(MsgErrorOf("int8 a\nint16 a"), "T.msg:2: \"int16 a\": there are two fields \"a\"");
  EXPECT_EQ(MsgErrorOf("int64 a\n---\nint64 b"),
            "T.msg:2: \"---\": a service or action is not one message");
}

TEST(Ros2Msg, ReadsTheTypesOfASchema) {
  const auto messages =
      ParseRos2Msg(std::string("a/Point p\nb/Point q\n") + kLine + "MSG: a/Point\nfloat64 x" +
                       kLine + "MSG: b/Point\nint8 y\n",
                   "pkg/msg/Type", "S");
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].name, "pkg/msg/Type");
  EXPECT_EQ(messages[1].name, "a/msg/Point");
  EXPECT_EQ(messages[2].fields[0].type, "int8");
}

TEST(Ros2Msg, AMessageWithoutFieldsMayComeFirst) {
  const auto messages =
      ParseRos2Msg(std::string(kLine) + "MSG: a/Point\nfloat64 x", "pkg/msg/Type", "S");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].name, "pkg/msg/Type");
  EXPECT_TRUE(messages[0].fields.empty());
  EXPECT_TRUE(ParseRos2Msg("", "pkg/msg/Type", "S").at(0).fields.empty());
}

TEST(Ros2Msg, TheTypeItselfMayHaveATitleToo) {
  const auto messages = ParseRos2Msg(
      std::string(kLine) + "MSG: a/Point\nfloat64 x" + kLine + "MSG: pkg/Type\na/Point p\n",
      "pkg/msg/Type", "S");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].name, "pkg/msg/Type");
  EXPECT_EQ(messages[0].fields.size(), 1u);
}

TEST(Ros2Msg, CompletesNamesOfOtherPackagesWhereOnlyOneIsMeant) {
  const auto one =
      ParseRos2Msg(std::string("Point p") + kLine + "MSG: a/Point\nfloat64 x", "pkg/msg/Type", "S");
  EXPECT_EQ(one[0].fields[0].type, "a/msg/Point");
  const auto own = ParseRos2Msg(
      std::string("Point p") + kLine + "MSG: a/Point\nfloat64 x" + kLine + "MSG: pkg/Point\nint8 x",
      "pkg/msg/Type", "S");
  EXPECT_EQ(own[0].fields[0].type, "pkg/msg/Point");
}

TEST(Ros2Msg, LinesCountThroughTheWholeSchema) {
  const auto parse = [](const std::string& schema) {
    return test::ErrorOf<DefinitionError>([&] { (void)ParseRos2Msg(schema, "pkg/msg/Type", "S"); });
  };
  EXPECT_EQ(parse("a/Point p\n====================\nMSG: a/Point\nfloat64 x\nfloat64"),
            "S:5: \"float64\": a type is followed by the name of a field");
  EXPECT_EQ(
      parse("int8 a\n====================\n\nint8 b"),
      "S:4: \"int8 b\": a line of = is followed by \"MSG: pkg/Name\" or \"IDL: pkg/msg/Name\"");
}

}  // namespace
}  // namespace scoria::logs
