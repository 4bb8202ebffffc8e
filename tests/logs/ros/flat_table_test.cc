// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/flat_table.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "logs/ros/message_error.h"
#include "tests/logs/ros/cdr_writer.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::CdrWriter;
using Texts = std::vector<std::string>;
constexpr int kXcdr1 = 0x0001;

Texts Read(FlatTable& table, const CdrWriter& message) {
  const auto cells = table.Read(message.bytes());
  return {cells.begin(), cells.end()};
}

TEST(FlatTable, ArraysAreColumnsByElement) {
  const MessageType type = test::TypeOf(std::string("uint8 mode\nfloat64[3] p\nMotor[2] motor") +
                                        test::kLine + "MSG: pkg/Motor\nfloat32 q\nbool on\n");
  FlatShape shape(type);
  EXPECT_FALSE(shape.varies());
  FlatTable table(shape);
  EXPECT_EQ(table.columns(), (Texts{"mode", "p[0]", "p[1]", "p[2]", "motor[0].q", "motor[0].on",
                                    "motor[1].q", "motor[1].on"}));
  CdrWriter message(kXcdr1);
  message.U8(200).F64(0.1).F64(-1e300).F64(std::nan("")).F32(0.1f).U8(1).F32(2.5f).U8(0);
  EXPECT_EQ(Read(table, message), (Texts{"200", "0.1", "-1e+300", "nan", "0.1", "1", "2.5", "0"}));
}

TEST(FlatTable, NumbersReadBackToTheSameBits) {
  const MessageType type = test::TypeOf("float64 d\nfloat32 f\nuint64 u\nint64 i\n");
  FlatTable table{FlatShape(type)};
  for (const double d : {1.0 / 3.0, 5e-324, 1.7976931348623157e308, -0.0, 123456789.123456789}) {
    const float f = 1.0f / 3.0f;
    CdrWriter message(kXcdr1);
    message.F64(d).F32(f).U64(18446744073709551615u).U64(1u << 31);
    const Texts cells = Read(table, message);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(cells[0].c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(d));
    EXPECT_EQ(std::strtof(cells[1].c_str(), nullptr), f);
    EXPECT_EQ(cells[2], "18446744073709551615");
    EXPECT_EQ(cells[3], "2147483648");
  }
}

TEST(FlatTable, SequencesHaveTheColumnsOfTheLongest) {
  const MessageType type = test::TypeOf(std::string("string[] name\nLeg[<=4] leg\nint32 last") +
                                        test::kLine + "MSG: pkg/Leg\nint32[] toe\n");
  FlatShape shape(type);
  EXPECT_TRUE(shape.varies());
  CdrWriter first(kXcdr1), second(kXcdr1);
  first.U32(2).Text("a").Text("b,\"c").U32(1).U32(2).U32(10).U32(11).U32(7);
  second.U32(1).Text("x").U32(2).U32(0).U32(1).U32(20).U32(8);
  shape.Measure(first.bytes());
  shape.Measure(second.bytes());
  FlatTable table(shape);
  EXPECT_EQ(table.columns(), (Texts{"name[0]", "name[1]", "leg[0].toe[0]", "leg[0].toe[1]",
                                    "leg[1].toe[0]", "leg[1].toe[1]", "last"}));
  EXPECT_EQ(Read(table, first), (Texts{"a", "b,\"c", "10", "11", "", "", "7"}));
  EXPECT_EQ(Read(table, second), (Texts{"x", "", "", "", "20", "", "8"}));
}

TEST(FlatTable, WhatWouldNeedTooManyColumnsIsAListPerLeaf) {
  const MessageType type =
      test::TypeOf(std::string("Point[] points\nuint8[2000] data\nstring[] words\nint32 last") +
                   test::kLine + "MSG: pkg/Point\nfloat64 x\nbool seen\n");
  FlatShape shape(type);
  CdrWriter message(kXcdr1);
  message.U32(600);
  for (int i = 0; i < 600; ++i) message.F64(i == 1 ? std::nan("") : 0.5 * i).U8(i % 2);
  message.Bytes(7, 2000).U32(2000);
  for (int i = 0; i < 2000; ++i) message.Text(i == 0 ? "say \"\n\"" : "b");
  message.U32(9);
  shape.Measure(message.bytes());
  FlatTable table(shape);
  EXPECT_EQ(table.columns(), (Texts{"points[].x", "points[].seen", "data[]", "words[]", "last"}));
  const Texts cells = Read(table, message);
  EXPECT_EQ(cells[0].substr(0, 13), "[0,NaN,1,1.5,");
  EXPECT_EQ(cells[0].substr(cells[0].size() - 7), ",299.5]");
  EXPECT_EQ(cells[1].substr(0, 5), "[0,1,");
  EXPECT_EQ(cells[2].size(), 2u * 2000 + 1);
  EXPECT_EQ(cells[3].substr(0, 24), "[\"say \\\"\\u000a\\\"\",\"b\",\"b");
  EXPECT_EQ(cells[4], "9");
  CdrWriter none(kXcdr1);
  none.U32(0).Bytes(7, 2000).U32(0).U32(9);
  EXPECT_EQ(Read(table, none)[0], "[]") << "nothing of the message before is left";
}

TEST(FlatTable, MessagesWithoutFieldsHaveNoCells) {
  const MessageType type = test::TypeOf("");
  FlatTable table{FlatShape(type)};
  EXPECT_TRUE(table.columns().empty());
  EXPECT_TRUE(Read(table, CdrWriter(kXcdr1).U8(0)).empty());
}

TEST(FlatTable, RefusesWhatIsNoMessageOfTheType) {
  const MessageType type = test::TypeOf("float64 x\nfloat64 y\n");
  FlatTable table{FlatShape(type)};
  EXPECT_NE(test::ErrorOf<MessageError>([&] {
              (void)Read(table, CdrWriter(kXcdr1).F64(1.0));
            }).find("pkg/msg/Type: y: "),
            std::string::npos);
}

}  // namespace
}  // namespace scoria::logs
