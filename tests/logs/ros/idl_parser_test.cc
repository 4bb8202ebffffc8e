// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/idl_parser.h"

#include <gtest/gtest.h>

#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::kLine;

std::vector<MessageDefinition> ParsedIdl(const std::string& text) {
  return ParseIdl(text, "T.idl");
}

std::string IdlErrorOf(const std::string& text) {
  return test::ErrorOf<DefinitionError>([&] { ParsedIdl(text); });
}

FieldDefinition IdlFieldOf(const std::string& before, const std::string& member) {
  return ParsedIdl("module pkg { module msg { " + before + " struct Type { " + member + " }; }; };")
      .at(0)
      .fields.at(0);
}

TEST(IdlParser, ReadsWhatRosidlWrites) {
  const auto messages = ParsedIdl(R"(// generated from rosidl_adapter/resource/msg.idl.em
#include "geometry_msgs/msg/Point.idl"
#include "std_msgs/msg/Header.idl"

module pkg {
  module msg {
    typedef geometry_msgs::msg::Point geometry_msgs__msg__Point__4[4];
    typedef double double__36[36];
    module Type_Constants {
      @verbatim (language="comment", text=
        "one" "\n" "two (2); }")
      const uint8 KEEP = 0;
      const string NAME = "a;b";
    };
    @verbatim (language="comment", text=
      "A message; with \"quotes\" and }")
    struct Type {
      std_msgs::msg::Header header;

      @unit (value="m")
      geometry_msgs__msg__Point__4 feet;
      double__36 covariance;
      @default (value="Hello ]")
      string<22> name;
      sequence<geometry_msgs::msg::Point> path;
      sequence<double, 3> bounded;
      wstring wide;
      octet raw;
      boolean flag;
    };
  };
};
)");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].name, "pkg/msg/Type");
  const std::vector<FieldDefinition> expected = {
      {"header", "std_msgs/msg/Header", Multiplicity::kOne, 0, 0, ""},
      {"feet", "geometry_msgs/msg/Point", Multiplicity::kArray, 4, 0, ""},
      {"covariance", "float64", Multiplicity::kArray, 36, 0, ""},
      {"name", "string", Multiplicity::kOne, 0, 22, ""},
      {"path", "geometry_msgs/msg/Point", Multiplicity::kSequence, 0, 0, ""},
      {"bounded", "float64", Multiplicity::kSequence, 3, 0, ""},
      {"wide", "wstring", Multiplicity::kOne, 0, 0, ""},
      {"raw", "uint8", Multiplicity::kOne, 0, 0, ""},
      {"flag", "bool", Multiplicity::kOne, 0, 0, ""}};
  EXPECT_EQ(messages[0].fields, expected);
  const std::vector<ConstantDefinition> constants = {{"uint8", "KEEP", "0"},
                                                     {"string", "NAME", "a;b"}};
  EXPECT_EQ(messages[0].constants, constants);
}

TEST(IdlParser, KnowsEveryPrimitive) {
  const auto messages = ParsedIdl(
      "struct Type { short a; unsigned short b; long c; unsigned long d; long long e;"
      " unsigned long long f; float g; double h; char i; int8 j; uint8 k; int16 l; uint16 m;"
      " int32 n; uint32 o; int64 p; uint64 q; };");
  std::string types;
  for (const FieldDefinition& field : messages.at(0).fields) types += field.type + " ";
  EXPECT_EQ(types,
            "int16 uint16 int32 uint32 int64 uint64 float32 float64 uint8 int8 uint8 int16 uint16 "
            "int32 uint32 int64 uint64 ");
}

TEST(IdlParser, ReadsTypedefsEnumsAndConstants) {
  EXPECT_EQ(IdlFieldOf("const unsigned long N = 0x10;", "double x[N];").count, 16u);
  EXPECT_EQ(IdlFieldOf("typedef double Row[3];", "Row x[2];").count, 6u);
  EXPECT_EQ(IdlFieldOf("", "double x[3][4];").count, 12u);
  EXPECT_EQ(IdlFieldOf("enum Mode { A, B = 5, C, };", "Mode x;").type, "uint32");
  EXPECT_EQ(IdlFieldOf("typedef sequence<string> Names;", "Names x;"),
            (FieldDefinition{"x", "string", Multiplicity::kSequence, 0, 0, ""}));
  const FieldDefinition bounded =
      IdlFieldOf("const short N = 7;", "sequence<string<N>, pkg::msg::N> x;");
  EXPECT_EQ(bounded.string_bound, 7u);
  EXPECT_EQ(bounded.count, 7u);
}

TEST(IdlParser, LooksNamesUpFromTheInnermostScope) {
  const auto messages = ParsedIdl(
      "module a { struct P { short x; }; module msg { struct P { long x; };"
      " struct Q { P inner; ::a::P outer; a::P other; Absent p; b::msg::P far; }; }; };");
  const auto& fields = messages.at(2).fields;
  EXPECT_EQ(fields[0].type, "a/msg/P");
  EXPECT_EQ(fields[1].type, "a/msg/P");  // a::P is "a/P", which is "a/msg/P"
  EXPECT_EQ(fields[3].type, "a/msg/Absent");
  EXPECT_EQ(fields[4].type, "b/msg/P");
}

TEST(IdlParser, OneMemberLineMayDeclareSeveral) {
  const auto messages = ParsedIdl("struct A { float x, y[2], z; };");
  ASSERT_EQ(messages.at(0).fields.size(), 3u);
  EXPECT_EQ(messages[0].fields[1].count, 2u);
  EXPECT_EQ(messages[0].fields[2].multiplicity, Multiplicity::kOne);
}

TEST(IdlParser, KeepsWhatDelimitersDependOn) {
  const auto messages = ParsedIdl(
      "@final struct A { short x; }; @extensibility(APPENDABLE) struct B { short x; };"
      "@nested @key struct C { @key @id(3) short x; };");
  EXPECT_EQ(messages.at(0).extensibility, Extensibility::kFinal);
  EXPECT_EQ(messages.at(1).extensibility, Extensibility::kAppendable);
  EXPECT_EQ(messages.at(2).extensibility, Extensibility::kAsMessage);
}

TEST(IdlParser, ReadsAConcatenatedSchemaInAnyOrder) {
  const std::string line = std::string(kLine).substr(1);
  const auto messages = ParsedIdl(
      line +
      "IDL: pkg/msg/Type\nmodule pkg { module msg { struct Type { pkg::msg::Vec v; }; }; };\n" +
      line +
      "IDL: pkg/msg/Vec\n#include <x>\nmodule pkg { module msg {\n typedef double D[3];"
      " struct Vec { D v; }; }; };\n");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].fields[0].type, "pkg/msg/Vec");
  EXPECT_EQ(messages[1].fields[0].count, 3u);
}

TEST(IdlParser, ErrorsNameLineTextAndRule) {
  EXPECT_EQ(IdlErrorOf("module a {\n union U"),
            "T.idl:2: \"union\": a module, struct, typedef, enum or const is expected");
  EXPECT_EQ(IdlErrorOf("struct A {\n float x\n};"), "T.idl:3: \"}\": \";\" is expected");
  EXPECT_EQ(IdlErrorOf("struct A { float x;"), "T.idl:1: \"end\": a name is expected");
  EXPECT_EQ(IdlErrorOf("struct A { long double x; };"),
            "T.idl:1: \"x\": long double is not a type of ROS messages");
  EXPECT_EQ(IdlErrorOf("struct A { map<long, long> x; };"), "T.idl:1: \"map\": is not read here");
  EXPECT_EQ(IdlErrorOf("struct A { @optional long x; };"),
            "T.idl:1: \"long\": @optional is not read");
  EXPECT_EQ(IdlErrorOf("@mutable struct A { long x; };"),
            "T.idl:1: \"struct\": a mutable struct is not read");
  EXPECT_EQ(IdlErrorOf("struct A : B { long x; };"),
            "T.idl:1: \":\": a struct that inherits is not read");
  EXPECT_EQ(IdlErrorOf("struct A { sequence<sequence<long>> x; };"),
            "T.idl:1: \"sequence\": a sequence of sequences is not read");
  EXPECT_EQ(IdlErrorOf("struct A { sequence<@x sequence<long>> x; };"),
            "T.idl:1: \"sequence\": a sequence of sequences is not read");
  EXPECT_EQ(IdlErrorOf("typedef long R[3]; struct A {\nsequence<R> x; };"),
            "T.idl:2: \"R\": a sequence of arrays or sequences is not read");
  EXPECT_EQ(IdlErrorOf("typedef sequence<long> R; struct A { R x[2]; };"),
            "T.idl:1: \"R\": an array of sequences is not read");
  EXPECT_EQ(IdlErrorOf("struct A { long x[N]; };"),
            "T.idl:1: \"N\": is not a length (1 to 4294967295)");
  EXPECT_EQ(IdlErrorOf("struct A { long x[65536][65536]; };"),
            "T.idl:1: \"int32\": the array is too long");
  EXPECT_EQ(IdlErrorOf("struct A { long x; long x; };"),
            "T.idl:1: \"x\": there are two fields of that name");
  EXPECT_EQ(IdlErrorOf("typedef B A; typedef A B; struct C { A x; };"),
            "T.idl:1: \"B\": typedefs go round in circles");
  EXPECT_EQ(IdlErrorOf("const long N = 3"), "T.idl:1: \"end\": \";\" is expected");
}

}  // namespace
}  // namespace scoria::logs
