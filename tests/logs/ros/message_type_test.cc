// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/message_type.h"

#include <gtest/gtest.h>

#include "logs/ros/field_path.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::kLine;
using test::TypeOf;

std::string TypeErrorOf(const std::string& schema) {
  return test::ErrorOf<DefinitionError>([&] { TypeOf(schema); });
}

std::uint64_t SizeAt(const MessageType& type, CdrVersion version, std::size_t position) {
  return type.root().ExtentIn(version).value().at(position);
}

TEST(MessageType, KnowsTheSizeOfFixedLayouts) {
  const MessageType type = TypeOf("uint8 a\nfloat64 b\nuint8[3] c\nint16 d");
  // 1, 7 of padding, 8, 3, 1 of padding, 2; from an odd position the padding differs.
  EXPECT_EQ(SizeAt(type, CdrVersion::kXcdr1, 0), 22u);
  EXPECT_EQ(SizeAt(type, CdrVersion::kXcdr1, 1), 21u);
  EXPECT_EQ(SizeAt(type, CdrVersion::kXcdr1, 7), 15u);
  EXPECT_EQ(SizeAt(type, CdrVersion::kXcdr2, 0), 18u);  // 8-byte numbers align to 4
  EXPECT_EQ(type.root().smallest, 14u);
}

TEST(MessageType, ArraysOfStructsRepeatTheirPadding) {
  const MessageType type = TypeOf(std::string("Item[3] items\nuint8 end") + kLine +
                                  "MSG: pkg/Item\nuint8 a\nuint32 b\nuint8 c");
  // 9 bytes, then 3 of padding before the next b: 9, 20 + 1 ... by hand: a0 b4 c8 | a9 b12 c16 |
  // a17 b20 c24.
  EXPECT_EQ(SizeAt(type, CdrVersion::kXcdr1, 0), 26u);
  EXPECT_FALSE(type.root().ExtentIn(CdrVersion::kXcdr2));  // XCDR2 writes the size of the array
}

TEST(MessageType, TextAndSequencesHaveNoFixedSize) {
  EXPECT_FALSE(TypeOf("string s").root().ExtentIn(CdrVersion::kXcdr1));
  EXPECT_FALSE(TypeOf("int8[] s").root().ExtentIn(CdrVersion::kXcdr1));
  EXPECT_EQ(TypeOf("string[3] s\nint8[] t").root().smallest, 16u);
}

TEST(MessageType, AMessageWithoutFieldsIsOneByte) {
  EXPECT_EQ(SizeAt(TypeOf(""), CdrVersion::kXcdr1, 0), 1u);
  EXPECT_TRUE(ListLeaves(TypeOf("")).empty());
  EXPECT_TRUE(ListLeaves(TypeOf("uint8 structure_needs_at_least_one_member")).empty());
}

TEST(MessageType, HugeArraysDoNotOverflow) {
  const MessageType type = TypeOf(std::string("Item[4294967295] items") + kLine +
                                  "MSG: pkg/Item\nfloat64[4294967295] x");
  EXPECT_GE(SizeAt(type, CdrVersion::kXcdr1, 0), std::uint64_t{1} << 40);
}

TEST(MessageType, ABareHeaderIsTheOneOfStdMsgs) {
  const MessageType type =
      TypeOf(std::string("Header header") + kLine +
             "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id" + kLine +
             "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec");
  EXPECT_EQ(type.StructOf(type.root().members[0]).name, "std_msgs/msg/Header");
}

TEST(MessageType, ErrorsNameTypeFieldAndWhatIsMissing) {
  EXPECT_EQ(TypeErrorOf("float65 x"),
            "pkg/msg/Type: x: no definition of pkg/msg/float65 (did you mean \"float64\"?)");
  EXPECT_EQ(TypeErrorOf("a/Pose x"), "pkg/msg/Type: x: no definition of a/msg/Pose");
  EXPECT_EQ(TypeErrorOf("Type x"), "pkg/msg/Type: x: pkg/msg/Type contains itself");
  EXPECT_EQ(
      TypeErrorOf(std::string("A a") + kLine + "MSG: pkg/A\nB b" + kLine + "MSG: pkg/B\nA[] a"),
      "pkg/msg/B: a: pkg/msg/A contains itself");
}

/// Types A0 to A`count`, each with `copies` of the next.
std::string Chain(int count, int copies) {
  std::string schema = "A0 a\n";
  for (int i = 0; i < count; ++i) {
    schema += std::string(kLine) + "MSG: pkg/A" + std::to_string(i) + "\n";
    for (int k = 0; k < copies; ++k) {
      schema += "A" + std::to_string(i + 1) + " m" + std::to_string(k) + "\n";
    }
  }
  return schema + kLine + "MSG: pkg/A" + std::to_string(count) + "\nbool x\n";
}

TEST(MessageType, RefusesTypesNestedTooDeepOrGrownTooLarge) {
  EXPECT_EQ(TypeErrorOf(Chain(62, 1)), "no error");
  EXPECT_EQ(TypeErrorOf(Chain(63, 1)), "pkg/msg/A63: nested deeper than 64 messages");
  EXPECT_EQ(TypeErrorOf(Chain(30, 2)), "pkg/msg/A10: more than 1000000 fields");
}

TEST(MessageType, ListsLeavesWithTheirShape) {
  const MessageType type =
      TypeOf(std::string("Item[3] items\nstring[] names\nItem one\nfloat64[<=4] b") + kLine +
             "MSG: pkg/Item\nuint8[2] a\nstring<=5 s");
  std::string text;
  for (const LeafShape& leaf : ListLeaves(type)) {
    text +=
        leaf.path + " " + std::string(NameOf(leaf.type)) + " " + std::to_string(leaf.count) + "\n";
  }
  EXPECT_EQ(text,
            "items[].a uint8 2\nitems[].s string 1\nnames string 0\none.a uint8 2\n"
            "one.s string 1\nb float64 4\n");
}

TEST(MessageType, DescribesTypesAsMsgTextsDo) {
  const MessageType type =
      TypeOf(std::string("float64 a\nstring<=5 b\nint8[3] c\nItem[] d\nstring<=2[<=4] e") + kLine +
             "MSG: pkg/Item\nuint8 a");
  std::string text;
  for (const Member& member : type.root().members) text += DescribeType(type, member) + " ";
  EXPECT_EQ(text, "float64 string<=5 int8[3] pkg/msg/Item[] string<=2[<=4] ");
}

}  // namespace
}  // namespace scoria::logs
