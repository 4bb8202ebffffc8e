// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/field_path.h"

#include <gtest/gtest.h>

#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::kLine;

const MessageType& Sample() {
  static const MessageType type = test::TypeOf(
      std::string("std_msgs/Header header\nImu imu_state\nMotor[20] motor_state\nuint32 tick\n"
                  "Motor[] more\nfloat64[<=3] few\nstring[] names") +
      kLine + "MSG: pkg/Imu\nfloat32[4] quaternion\nfloat32[3] gyroscope\n" + kLine +
      "MSG: pkg/Motor\nfloat32 q\nfloat32 dq\n" + kLine +
      "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + kLine +
      "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  return type;
}

std::string ErrorOf(const std::string& path) {
  return test::ErrorOf<FieldPathError>([&] { (void)ResolveField(Sample(), path); });
}

TEST(FieldPath, FindsNumbersArraysTextsAndTimes) {
  EXPECT_EQ(ResolveField(Sample(), "imu_state.quaternion[2]").type, FieldType::kFloat32);
  EXPECT_EQ(ResolveField(Sample(), "imu_state.quaternion[2]").multiplicity, Multiplicity::kOne);
  EXPECT_EQ(ResolveField(Sample(), "imu_state.quaternion").multiplicity, Multiplicity::kArray);
  EXPECT_EQ(ResolveField(Sample(), "imu_state.quaternion").count, 4u);
  EXPECT_EQ(ResolveField(Sample(), "motor_state[3].q").type, FieldType::kFloat32);
  EXPECT_EQ(ResolveField(Sample(), "more[1000000].q").type, FieldType::kFloat32);
  EXPECT_EQ(ResolveField(Sample(), "names").type, FieldType::kString);
  EXPECT_EQ(ResolveField(Sample(), "header.stamp").type, FieldType::kTime);
  EXPECT_EQ(ResolveField(Sample(), "header.stamp.sec").type, FieldType::kInt32);
}

TEST(FieldPath, AWrongNameIsAnsweredWithTheNearest) {
  EXPECT_EQ(ErrorOf("imu_state.quaternon[2]"),
            "imu_state.quaternon[2]: pkg/msg/Imu has no field \"quaternon\" (did you mean "
            "\"quaternion\"?)");
  EXPECT_EQ(ErrorOf("imu"), "imu: pkg/msg/Type has no field \"imu\"");
}

TEST(FieldPath, ElementsAreHeldAgainstTheArray) {
  EXPECT_EQ(ErrorOf("motor_state[20].q"),
            "motor_state[20].q: motor_state is pkg/msg/Motor[20]: elements 0 to 19");
  EXPECT_EQ(ErrorOf("few[3]"), "few[3]: few is float64[<=3]: elements 0 to 2");
  EXPECT_EQ(ErrorOf("tick[0]"), "tick[0]: tick is one uint32, not an array");
  EXPECT_EQ(ErrorOf("motor_state.q"),
            "motor_state.q: motor_state is pkg/msg/Motor[20]: one element is needed, such as "
            "motor_state[0]");
}

TEST(FieldPath, APathEndsAtAValue) {
  EXPECT_EQ(ErrorOf("imu_state"),
            "imu_state: imu_state is pkg/msg/Imu, whose fields are: gyroscope, quaternion");
  EXPECT_EQ(ErrorOf("motor_state[0]"),
            "motor_state[0]: motor_state is pkg/msg/Motor[20], whose fields are: dq, q");
  EXPECT_EQ(ErrorOf("tick.x"), "tick.x: tick is uint32 and has no fields");
}

TEST(FieldPath, RefusesWhatIsNoPath) {
  EXPECT_EQ(ErrorOf(""), ": \"\" is not the name of a field");
  EXPECT_EQ(ErrorOf("a..b"), "a..b: pkg/msg/Type has no field \"a\"");
  EXPECT_EQ(ErrorOf("imu_state..x"), "imu_state..x: \"\" is not the name of a field");
  EXPECT_EQ(ErrorOf("few[x]"), "few[x]: \"[x]\" is not an element, such as [0]");
  EXPECT_EQ(ErrorOf("few[-1]"), "few[-1]: \"[-1]\" is not an element, such as [0]");
  EXPECT_EQ(ErrorOf("few[1"), "few[1: \"[1\" is not an element, such as [0]");
  EXPECT_EQ(ErrorOf("few[1]2"), "few[1]2: \"[1]2\" is not an element, such as [0]");
  EXPECT_EQ(ErrorOf("few[99999999999999999999]"),
            "few[99999999999999999999]: \"[99999999999999999999]\" is not an element, such as [0]");
}

}  // namespace
}  // namespace scoria::logs
