// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/cdr.h"

#include <gtest/gtest.h>

#include "logs/messages/scoria.h"

namespace scoria::logs {
namespace {

TEST(Cdr, LayoutFollowsTheRos2WireFormat) {
  msg::ContactState message;
  message.header.stamp = {7, 9};
  message.header.frame_id = "ab";
  message.ground_contact_force = {1.0, 2.0, 3.0, 4.0};
  Bytes bytes;
  EncodeCdr(message, bytes);
  // 4 encapsulation, 4 + 4 stamp, 4 + 3 string with terminator, 1 padding to 8, 4 doubles.
  ASSERT_EQ(bytes.size(), 4u + 8u + 7u + 1u + 32u);
  EXPECT_EQ(bytes[1], std::byte{1});  // little endian
  EXPECT_EQ(bytes[4], std::byte{7});
  EXPECT_EQ(bytes[12], std::byte{3});
  EXPECT_EQ(bytes[19], std::byte{0});  // padding is zero: equal messages are equal bytes
}

TEST(Cdr, EveryFieldSurvivesTheRoundTrip) {
  msg::ControllerInput input;
  input.step = 12345678901;
  input.q_rad[11] = -0.25;
  input.pattern = 2;
  input.wbc_fault = 3;
  Bytes bytes;
  EncodeCdr(input, bytes);
  auto back = DecodeCdr<msg::ControllerInput>(bytes);
  FieldLister a, b;
  input.Serialize(a);
  back.Serialize(b);
  EXPECT_EQ(a.fields(), b.fields());
  EXPECT_ANY_THROW((void)DecodeCdr<msg::ControllerInput>(std::span(bytes).first(bytes.size() / 2)));
}

TEST(Cdr, LongStringsFindRoom) {
  msg::Event event{1, "kind", std::string(100000, 'y')};
  Bytes bytes;
  EncodeCdr(event, bytes);
  EXPECT_EQ(DecodeCdr<msg::Event>(bytes).detail.size(), 100000u);
}

TEST(Schema, NestedTypesFollowOnce) {
  const std::string schema = SchemaWriter::SchemaOf<msg::QuadState>();
  EXPECT_EQ(schema.find("std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"), 0u)
      << schema;
  EXPECT_NE(
      schema.find("bool[4] foot_contact\nfloat64[12] ground_contact_force\nbool belly_contact\n"),
      std::string::npos);
  const auto first = schema.find("MSG: std_msgs/Header\n");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(schema.find("MSG: std_msgs/Header\n", first + 1), std::string::npos);
}

}  // namespace
}  // namespace scoria::logs
