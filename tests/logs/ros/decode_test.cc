// SPDX-License-Identifier: BSD-3-Clause
// Messages in all encodings, read by FieldReader, VisitLeaves and CheckMessage.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "logs/ros/check_message.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/idl_parser.h"
#include "logs/ros/message_error.h"
#include "logs/ros/visit_leaves.h"
#include "tests/logs/ros/cdr_writer.h"
#include "tests/logs/ros/types.h"
#include "tests/support/allocation_guard.h"

namespace scoria::logs {
namespace {

using test::CdrWriter;
using test::kLine;
using test::TypeOf;

std::vector<std::byte> FromHex(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

std::string Listed(const MessageType& type, const std::vector<std::byte>& message) {
  std::string text;
  VisitLeaves(type, message, [&](const LeafPath& path, const FieldView& view) {
    text += path.Text() + "=";
    for (std::size_t i = 0; i < view.size(); ++i) text += view.Format(i) + ",";
    text += " ";
  });
  return text;
}

std::string ErrorOf(const MessageType& type, const std::vector<std::byte>& message) {
  return test::ErrorOf<MessageError>([&] { CheckMessage(type, message); });
}

TEST(Decode, ReadsWhatAnotherLibraryWrote) {
  // {u32 1, f64 2.5} by CdrWriter of @foxglove/cdr 3.5.0.
  const MessageType type = TypeOf("uint32 a\nfloat64 b");
  for (const char* hex :
       {"0001000001000000000000000000000000000440", "0000000000000001000000004004000000000000",
        "00070000010000000000000000000440", "00110000010000000000000000000440"}) {
    EXPECT_EQ(Listed(type, FromHex(hex)), "a=1, b=2.5, ") << hex;
    EXPECT_NO_THROW(CheckMessage(type, FromHex(hex))) << hex;
  }
}

TEST(Decode, ReadsEveryPrimitiveAtItsLimits) {
  const MessageType type = TypeOf(
      "bool a\nbyte b\nchar c\nint8 d\nuint8 e\nint16 f\nuint16 g\nint32 h\nuint32 i\nint64 j\n"
      "uint64 k\nfloat32 l\nfloat64 m\nstring n");
  for (const int id : {0x00, 0x01, 0x06, 0x07}) {
    CdrWriter w(id);
    w.U8(1).U8(255).U8(127).U8(0x80).U8(200).U16(0x8000).U16(65535).U32(0x80000000).U32(4294967295);
    w.U64(std::uint64_t{1} << 63).U64(~std::uint64_t{0}).F32(0.1F).F64(-1e300).Text("a\nb");
    EXPECT_EQ(
        Listed(type, w.bytes()),
        "a=true, b=255, c=127, d=-128, e=200, f=-32768, g=65535, h=-2147483648, i=4294967295, "
        "j=-9223372036854775808, k=18446744073709551615, l=0.1, m=-1e+300, n=a\nb, ")
        << id;
  }
}

TEST(Decode, ValuesAreExactInTheirKinds) {
  const MessageType type =
      TypeOf(std::string("uint64 big\nT t\nT before\nfloat32 nan\nbool yes\n") + kLine +
             "MSG: pkg/T\nint32 sec\nuint32 nanosec");
  CdrWriter w(0x01);
  w.U64(0xFFFFFFFFFFFFFFFF).U32(1700000000).U32(123456789).U32(0xFFFFFFFF).U32(500000000);
  w.F32(std::numeric_limits<float>::quiet_NaN()).U8(1);
  FieldReader reader(type, {"big", "t", "before", "nan", "yes", "t.nanosec"});
  const auto values = reader.Read(w.bytes());
  EXPECT_EQ(static_cast<std::uint64_t>(values[0].Int()), 0xFFFFFFFFFFFFFFFF);
  EXPECT_EQ(values[0].Double(), 18446744073709551616.0);
  EXPECT_EQ(values[1].Int(), 1700000000123456789);
  EXPECT_EQ(values[1].Format(), "1700000000.123456789");
  EXPECT_EQ(values[2].Int(), -500000000);
  EXPECT_EQ(values[2].Format(), "-0.500000000");
  EXPECT_EQ(values[2].Double(), -0.5);
  EXPECT_TRUE(std::isnan(values[3].Double()));
  EXPECT_EQ(values[4].Int(), 1);
  EXPECT_EQ(values[5].Int(), 123456789);
}

TEST(Decode, AlignmentCountsFromBehindTheEncapsulation) {
  const MessageType type = TypeOf("string s\nfloat64 x");
  for (std::size_t length = 0; length < 9; ++length) {
    const std::string text(length, 'x');
    EXPECT_EQ(Listed(type, CdrWriter(0x01).Text(text).F64(1.5).bytes()), "s=" + text + ", x=1.5, ");
  }
}

TEST(Decode, TakesEmptyTextWithAndWithoutTerminator) {
  const MessageType type = TypeOf("string s\nint8 x");
  EXPECT_EQ(Listed(type, CdrWriter(0x01).U32(0).U8(3).bytes()), "s=, x=3, ");
  EXPECT_EQ(Listed(type, CdrWriter(0x01).Text("").U8(3).bytes()), "s=, x=3, ");
}

TEST(Decode, AnEmptySequenceHasNoPaddingBehind) {
  // An empty sequence of 8-byte numbers ends with its length.
  const MessageType type = TypeOf("float64[] x\nint8 y");
  EXPECT_EQ(Listed(type, CdrWriter(0x01).U32(0).U8(7).bytes()), "x= y=7, ");
}

TEST(Decode, AMessageWithoutFieldsIsOneByteEverywhere) {
  const MessageType type =
      TypeOf(std::string("Empty a\nint8 b\nEmpty[2] c\nint8 d") + kLine + "MSG: pkg/Empty\n");
  EXPECT_EQ(Listed(type, CdrWriter(0x01).U8(0).U8(5).U8(0).U8(0).U8(6).bytes()), "b=5, d=6, ");
  EXPECT_NO_THROW(CheckMessage(TypeOf(""), FromHex("0001000000")));
}

TEST(Decode, WideTextOfBothWidths) {
  const MessageType type = TypeOf("wstring s\nwstring[] t\nint8 end");
  for (const int width : {4, 2}) {
    CdrWriter w(0x01);
    const auto bytes = static_cast<std::size_t>(width);
    w.WideText(U"aé", bytes)
        .U32(2)
        .WideText(U"\xD83D\xDE00", bytes)
        .WideText(U"\xD800z", bytes)
        .U8(1);
    EXPECT_EQ(Listed(type.WithWideChars(width), w.bytes()), "s=aé, t=😀,\uFFFDz, end=1, ");
    EXPECT_NE(ErrorOf(type.WithWideChars(6 - width), w.bytes()), "no error");
  }
}

TEST(Decode, DelimitersOfXcdr2) {
  // XTypes 7.4.3.5: structs that may be appended to, and collections of other than primitives.
  const MessageType type =
      TypeOf(std::string("int8 a\nItem one\nItem[2] two\nstring[] names\nfloat64[] x\nint8 b") +
             kLine + "MSG: pkg/Item\nint8 v\n");
  for (const int id : {0x08, 0x09, 0x14, 0x15}) {
    CdrWriter w(id);
    const auto item = [&](int v) {
      const auto size = w.BeginSized();
      w.U8(static_cast<std::uint64_t>(v));
      w.EndSized(size);
    };
    const auto all = w.BeginSized();
    w.U8(1);
    item(2);
    const auto two = w.BeginSized();
    item(3), item(4);
    w.EndSized(two);
    const auto names = w.BeginSized();
    w.U32(2).Text("p").Text("qr");
    w.EndSized(names);
    w.U32(1).F64(0.5).U8(9);
    w.EndSized(all);
    EXPECT_EQ(Listed(type, w.bytes()),
              "a=1, one.v=2, two[0].v=3, two[1].v=4, names=p,qr, x=0.5, b=9, ");
  }
  CdrWriter plain(0x07);  // without those of structs
  plain.U8(1).U8(2).U32(2).U8(3).U8(4);
  const auto names = plain.BeginSized();
  plain.U32(2).Text("p").Text("qr");
  plain.EndSized(names);
  plain.U32(1).F64(0.5).U8(9);
  EXPECT_EQ(Listed(type, plain.bytes()),
            "a=1, one.v=2, two[0].v=3, two[1].v=4, names=p,qr, x=0.5, b=9, ");
}

TEST(Decode, AnnotationsDecideOnDelimiters) {
  const MessageType type =
      TypeOf(ParseIdl("struct Root { int8 a; F f; A g; }; @final struct F { int8 v; };"
                      "@appendable struct A { int8 v; };",
                      "idl"));
  CdrWriter plain(0x07);
  plain.U8(1).U8(2).U32(1).U8(3);
  EXPECT_EQ(Listed(type, plain.bytes()), "a=1, f.v=2, g.v=3, ");
  CdrWriter delimited(0x09);
  delimited.U32(9).U8(1).U8(2).U32(1).U8(3);
  EXPECT_EQ(Listed(type, delimited.bytes()), "a=1, f.v=2, g.v=3, ");
  EXPECT_EQ(Listed(type, CdrWriter(0x01).U8(1).U8(2).U8(3).bytes()), "a=1, f.v=2, g.v=3, ");
}

TEST(DecodeErrors, Encapsulation) {
  const MessageType type = TypeOf("int8 a");
  EXPECT_EQ(ErrorOf(type, {}), "pkg/msg/Type: 0 bytes are too few for an encapsulation (4)");
  EXPECT_EQ(ErrorOf(type, FromHex("000100")),
            "pkg/msg/Type: 3 bytes are too few for an encapsulation (4)");
  for (const char* id : {"0002", "0003", "000a", "000b", "0012", "0013"}) {
    EXPECT_EQ(ErrorOf(type, FromHex(std::string(id) + "000000")),
              std::string("pkg/msg/Type: encapsulation 0x") + id +
                  " is a parameter list (PL_CDR, mutable types), which is not decoded");
  }
  EXPECT_EQ(ErrorOf(type, FromHex("0004000000")), "pkg/msg/Type: encapsulation 0x0004 is not CDR");
  EXPECT_EQ(ErrorOf(type, FromHex("0101000000")), "pkg/msg/Type: encapsulation 0x0101 is not CDR");
}

TEST(DecodeErrors, NameTheFieldTheRuleAndTheByte) {
  const MessageType type =
      TypeOf(std::string("Item[] items\n") + kLine + "MSG: pkg/Item\nstring name\nbool[2] b\n");
  EXPECT_EQ(ErrorOf(type, CdrWriter(0x01).U32(2).Text("a").U8(0).U8(1).Text("b").U8(0).bytes()),
            "pkg/msg/Type: items[1].b: 2 bytes are needed, 1 are left (at byte 22 of 23)");
  EXPECT_EQ(ErrorOf(type, CdrWriter(0x01).U32(2).Text("a").U8(0).U8(7).Text("b").U8(0).bytes()),
            "pkg/msg/Type: items[0].b[1]: a bool is 0 or 1, not 7 (at byte 15 of 23)");
  EXPECT_EQ(
      ErrorOf(type, CdrWriter(0x01).U32(1).U32(2).U8('a').U8('b').U8(0).U8(1).bytes()),
      "pkg/msg/Type: items[0].name: a string without a zero byte at its end (at byte 12 of 16)");
  EXPECT_EQ(
      ErrorOf(type, CdrWriter(0x01).U32(1).U32(0xFFFFFFFF).U8('a').U8(0).bytes()),
      "pkg/msg/Type: items[0].name: a string of 4294967295 bytes, 2 are left (at byte 12 of 14)");
  EXPECT_EQ(
      ErrorOf(type, CdrWriter(0x01).U32(0xFFFFFFFF).U32(1).bytes()),
      "pkg/msg/Type: items: 4294967295 elements of at least 6 bytes, 4 bytes are left (at byte "
      "8 of 12)");
  EXPECT_EQ(
      ErrorOf(type, CdrWriter(0x01).U32(1).U32(3).U8(0xC3).U8(0x28).U8(0).U8(0).U8(1).bytes()),
      "pkg/msg/Type: items[0].name: not a text: \"\\xC3(\"");
  EXPECT_EQ(ErrorOf(TypeOf("string[] names"), CdrWriter(0x01).U32(2).Text("a").U32(9).bytes()),
            "pkg/msg/Type: names[1]: a string of 9 bytes, 0 are left (at byte 20 of 20)");
}

TEST(DecodeErrors, BoundsAndRemainders) {
  EXPECT_EQ(ErrorOf(TypeOf("string<=3 s"), CdrWriter(0x01).Text("abcd").bytes()),
            "pkg/msg/Type: s: a string of 4 characters, at most 3 are allowed (at byte 8 of 13)");
  EXPECT_EQ(ErrorOf(TypeOf("int8[<=3] s"), CdrWriter(0x01).U32(4).U32(0).bytes()),
            "pkg/msg/Type: s: 4 elements, at most 3 are allowed (at byte 8 of 12)");
  EXPECT_EQ(ErrorOf(TypeOf("wstring<=3 s"), CdrWriter(0x01).WideText(U"abcd", 4).bytes()),
            "pkg/msg/Type: s: a wstring of 4 characters, at most 3 are allowed (at byte 8 of 24)");
  EXPECT_EQ(
      ErrorOf(TypeOf("wstring s"), CdrWriter(0x01).U32(4).U32(0).bytes()),
      "pkg/msg/Type: s: a wstring of 4 4-byte characters, 4 bytes are left (at byte 8 of 12)");
  EXPECT_EQ(ErrorOf(TypeOf("int8 a"), CdrWriter(0x01).U8(1).Bytes(0, 3).bytes()), "no error");
  EXPECT_EQ(ErrorOf(TypeOf("int8 a"), CdrWriter(0x01).U8(1).Bytes(0, 4).bytes()),
            "pkg/msg/Type: 4 of 9 bytes are left behind the last field (at most 3 of padding are "
            "allowed)");
}

TEST(DecodeErrors, DelimitersMustAgree) {
  const MessageType type =
      TypeOf(std::string("Item one\nint8 b") + kLine + "MSG: pkg/Item\nint8 v\n");
  EXPECT_EQ(ErrorOf(type, CdrWriter(0x09).U32(6).U32(2).U8(1).U8(2).bytes()),
            "pkg/msg/Type: one: its delimiter says that it ends at byte 14 (at byte 13 of 14)");
  EXPECT_EQ(ErrorOf(type, CdrWriter(0x09).U32(7).U32(1).U8(1).U8(2).bytes()),
            "pkg/msg/Type: a delimiter says 7 bytes, 6 are left (at byte 8 of 14)");
}

TEST(FieldReader, ReadsInAnyOrderAndTwice) {
  const MessageType type =
      TypeOf(std::string("string name\nItem[3] items\nfloat64[] x\nstring[] names") + kLine +
             "MSG: pkg/Item\nuint8 a\nfloat32 b\n");
  CdrWriter w(0x00);
  w.Text("n")
      .U8(1)
      .F32(0.5F)
      .U8(2)
      .F32(1.5F)
      .U8(3)
      .F32(2.5F)
      .U32(2)
      .F64(7)
      .F64(8)
      .U32(2)
      .Text("p")
      .Text("q");
  FieldReader reader(type, {"x[1]", "items[2].b", "name", "x", "items[2].b", "items[0].a", "x[2]",
                            "names[1]", "names", "names[2]"});
  const auto values = reader.Read(w.bytes());
  EXPECT_EQ(values[0].Double(), 8.0);
  EXPECT_EQ(values[1].Double(), 2.5);
  EXPECT_EQ(values[2].Text(), "n");
  ASSERT_EQ(values[3].size(), 2u);
  EXPECT_EQ(values[3].Double(0), 7.0);
  EXPECT_EQ(values[4].Double(), 2.5);
  EXPECT_EQ(values[5].Int(), 1);
  EXPECT_TRUE(values[6].IsAbsent());
  EXPECT_EQ(values[7].Text(), "q");
  EXPECT_EQ(values[8].Texts(), (std::vector<std::string>{"p", "q"}));
  EXPECT_TRUE(values[9].IsAbsent());
}

TEST(FieldReader, WhatIsGoneInTheNextMessageIsAbsent) {
  const MessageType type = TypeOf("float64[] x");
  FieldReader reader(type, {"x[0]", "x"});
  const std::vector<std::byte> full = CdrWriter(0x01).U32(1).F64(2).bytes();
  const std::vector<std::byte> empty = CdrWriter(0x01).U32(0).bytes();
  EXPECT_FALSE(reader.Read(full)[0].IsAbsent());
  EXPECT_TRUE(reader.Read(empty)[0].IsAbsent());
  EXPECT_EQ(reader.Read(empty)[1].size(), 0u);
  EXPECT_FALSE(reader.Read(empty)[1].IsAbsent());
}

TEST(FieldReader, ElementsOfSequencesOfStructs) {
  const MessageType type =
      TypeOf(std::string("P[] path\nint8 end") + kLine + "MSG: pkg/P\nfloat32 x\nstring s\n");
  FieldReader reader(type, {"path[1].x", "end", "path[4].x"});
  const std::vector<std::byte> bytes =
      CdrWriter(0x01).U32(2).F32(1).Text("ab").F32(2).Text("c").U8(5).bytes();
  const auto values = reader.Read(bytes);
  EXPECT_EQ(values[0].Double(), 2.0);
  EXPECT_EQ(values[1].Int(), 5);
  EXPECT_TRUE(values[2].IsAbsent());
}

TEST(FieldReader, DoesNotAllocate) {
  const MessageType type = TypeOf(std::string("string name\nItem[3] items\nfloat64[] x") + kLine +
                                  "MSG: pkg/Item\nuint8 a\nfloat32 b\n");
  const std::vector<std::byte> bytes = CdrWriter(0x01)
                                           .Text("n")
                                           .U8(1)
                                           .F32(0.5F)
                                           .U8(2)
                                           .F32(1.5F)
                                           .U8(3)
                                           .F32(2.5F)
                                           .U32(1)
                                           .F64(7)
                                           .bytes();
  FieldReader reader(type, {"x[0]", "items[2].b", "name"});
  double sum = 0.0;
  test::AllocationGuard guard;
  const auto values = reader.Read(bytes);
  sum = values[0].Double() + values[1].Double() + static_cast<double>(values[2].Text().size());
  EXPECT_EQ(guard.count(), 0);
  EXPECT_EQ(sum, 10.5);
}

}  // namespace
}  // namespace scoria::logs
