// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/write_msg.h"

#include <gtest/gtest.h>

#include "logs/ros/definition_source.h"
#include "logs/ros/type_resolver.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

TEST(WriteRos2Msg, ReadsBackToTheSameType) {
  const std::string schema =
      std::string(
          "std_msgs/Header header\nstring<=12 name\nwstring[] words\nuint8[<=4] few\n"
          "int16[3] three\nother_msgs/Part[] parts\nEmpty nothing\nfloat32 last\n") +
      test::kLine + "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
      test::kLine + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + test::kLine +
      "MSG: other_msgs/Part\nbool[2] on\nbyte b\n" + test::kLine + "MSG: pkg/Empty\n";
  const MessageType type = test::TypeOf(schema);
  EXPECT_EQ(test::TypeOf(WriteRos2Msg(type)), type) << WriteRos2Msg(type);
}

TEST(WriteRos2Msg, KeepsEveryBuiltInType) {
  for (const char* name :
       {"interfaces/msg/QuadState", "interfaces/msg/GaitSequence", "unitree_go/msg/LowState",
        "sensor_msgs/msg/JointState", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"}) {
    const TypeChoice choice = TypeResolver().Resolve({name, "cdr", "", ""});
    ASSERT_NE(choice.taken(), nullptr) << name;
    const MessageType& type = choice.taken()->type;
    const auto parsed = ParseRos2Msg(WriteRos2Msg(type), name, "schema");
    EXPECT_EQ(test::TypeOf(parsed), type) << name;
  }
}

}  // namespace
}  // namespace scoria::logs
