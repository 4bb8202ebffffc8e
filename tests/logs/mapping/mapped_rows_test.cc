// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/mapped_rows.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "logs/mapping/choose_mapping.h"
#include "logs/messages/scoria.h"
#include "tests/logs/mapping/field_messages.h"
#include "tests/logs/mapping/times.h"
#include "tests/logs/ros/cdr_writer.h"
#include "tests/support/memory_log.h"

namespace scoria::logs {
namespace {

using test::CdrWriter;
using test::JointState;
using test::kLittleEndian;
using test::LowCmd;
using test::LowState;
using test::MemoryLog;
using test::WriteStamp;
using test::ZeroMessage;

using test::kMs;
constexpr std::int64_t kStart_ns = test::kRecordingStart_ns;

struct Mapped {
  std::vector<Row> rows;
  MappingReport report;
};

/// By the shipped mapping that fits.
Mapped ReadRows(MemoryLog& log) {
  Mapped out;
  const Mapping& mapping = ChooseMapping(log.contents(), ShippedMappings());
  out.report = ForEachMappedRow(log, mapping, TypeResolver(),
                                [&](const Row& row) { out.rows.push_back(row); });
  return out;
}

TEST(MappedRows, Go2IsInOurOrderAndItsTickUndoesBursts) {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/relay/lowstate", "unitree_go/msg/LowState"),
                    cmd = log.AddChannel("/lowcmd", "unitree_go/msg/LowCmd");
  constexpr std::uint32_t kNearWrap = 0xffffffff - 300;
  for (int i = 0; i < 400; ++i) {  // sent every 2 ms, received ten at a time
    const std::int64_t received_ns = kStart_ns + (2 * (i - i % 10) + 20) * kMs + 1000 * (i % 10);
    log.Add(state, received_ns, LowState(kNearWrap + 2 * static_cast<std::uint32_t>(i)));
    if (i % 10 == 0) log.Add(cmd, received_ns, LowCmd(i < 200 ? 2.146e9f : 0.5f));
  }
  const Mapped mapped = ReadRows(log);
  EXPECT_EQ(mapped.report.mapping, "unitree_go2");
  EXPECT_EQ(mapped.report.absent, (std::vector<std::string>{"sport", "vicon"}));
  EXPECT_TRUE(mapped.report.topics[1].clock.starts_with("counter (steps of 2 ms, irregularity 0;"))
      << mapped.report.topics[1].clock;
  ASSERT_EQ(mapped.rows.size(), 400u);
  for (std::size_t i = 1; i < mapped.rows.size(); ++i)
    EXPECT_NEAR(mapped.rows[i].time_s - mapped.rows[i - 1].time_s, 0.002, 1e-9) << i;
  const MeasuredRow& m = *mapped.rows[10].measured;
  constexpr std::array<std::size_t, 4> kMotorOfLeg = {3, 0, 9, 6};  // FL FR HL HR of FR FL RR RL
  for (std::size_t leg = 0; leg < 4; ++leg) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto motor = static_cast<float>(kMotorOfLeg[leg] + j);
      EXPECT_EQ((*m.q_rad)[3 * leg + j], static_cast<double>(0.1f * (motor + 1)));
      EXPECT_EQ((*m.qd_radps)[3 * leg + j], motor);
      EXPECT_EQ((*m.tau_Nm)[3 * leg + j], -motor);
    }
    EXPECT_EQ((*m.foot_force_counts)[leg], 10.0 * static_cast<double>(kMotorOfLeg[leg] / 3 + 1));
  }
  EXPECT_NEAR((*m.rpy_WS_rad)[0], 0.2, 1e-6);
  EXPECT_EQ((*m.w_WS_S_radps)[2], 3.0);
  EXPECT_NEAR((*m.a_WS_S_mps2)[2], 9.6, 1e-6);
  EXPECT_NEAR(*m.battery_V, 28.5, 1e-6);
  EXPECT_FALSE(mapped.rows[100].joint_command->q_rad);  // 2.146e9: no command
  EXPECT_EQ((*mapped.rows[100].joint_command->kp_Nm_per_rad)[0], 40.0);
  EXPECT_EQ((*mapped.rows[350].joint_command->q_rad)[0], 0.5);
}

Bytes Odometry(std::int64_t time_ns, double yaw_rad) {
  CdrWriter out(kLittleEndian);
  WriteStamp(out, time_ns, "odom");
  out.Text("base_link");
  out.F64(1.0).F64(2.0).F64(0.3);
  out.F64(0.0).F64(0.0).F64(std::sin(yaw_rad / 2)).F64(std::cos(yaw_rad / 2));
  for (int i = 0; i < 36; ++i) out.F64(0.0);
  out.F64(0.5).F64(0.0).F64(0.0);  // forwards, in the body's axes
  for (int i = 0; i < 3 + 36; ++i) out.F64(0.0);
  return out.bytes();
}

TEST(MappedRows, JointsGoByNamesThatMayChangeTheirOrder) {
  MemoryLog log;
  const std::size_t joints = log.AddChannel("/robot/joint_states", "sensor_msgs/msg/JointState"),
                    odometry = log.AddChannel("/odom", "nav_msgs/msg/Odometry");
  std::vector<std::string> names;
  std::vector<double> values;
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    for (const char* joint : {"HAA", "HFE", "KFE"}) {
      names.push_back(std::string(leg) + "_" + joint);
      values.push_back(0.1 * static_cast<double>(names.size()));
    }
  }
  names.emplace_back("arm_joint_1");
  values.push_back(9.0);
  for (int i = 0; i < 20; ++i) {
    log.Add(joints, kStart_ns + i * 10 * kMs, JointState(kStart_ns + i * 10 * kMs, names, values));
    log.Add(odometry, kStart_ns + i * 10 * kMs,
            Odometry(kStart_ns + i * 10 * kMs, std::numbers::pi / 2));
    std::rotate(names.begin(), names.begin() + 5, names.end());
    std::rotate(values.begin(), values.begin() + 5, values.end());
  }
  const Mapped mapped = ReadRows(log);
  EXPECT_EQ(mapped.report.mapping, "ros2_standard");
  ASSERT_EQ(mapped.rows.size(), 20u);
  for (const Row& row : mapped.rows) {
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_DOUBLE_EQ((*row.measured->q_rad)[k], 0.1 * static_cast<double>(k + 1));
      EXPECT_DOUBLE_EQ((*row.measured->qd_radps)[k], static_cast<double>(k + 1));
    }
    EXPECT_FALSE(row.measured->tau_Nm);  // the array is empty
    EXPECT_NEAR(row.estimate->v_WB_mps[0], 0.0, 1e-12);
    EXPECT_NEAR(row.estimate->v_WB_mps[1], 0.5, 1e-12);
    EXPECT_NEAR(row.estimate->rpy_rad[2], std::numbers::pi / 2, 1e-12);
  }
}

TEST(MappedRows, TwoTopicsOfATypeAreNamed) {
  MemoryLog log;
  (void)log.AddChannel("/a", "sensor_msgs/msg/JointState");
  (void)log.AddChannel("/b", "sensor_msgs/msg/JointState");
  try {
    ForEachMappedRow(log, FindMapping("ros2_standard"), TypeResolver(), [](const Row&) {});
    FAIL();
  } catch (const core::ConfigError& e) {
    EXPECT_STREQ(
        e.what(),
        "mappings/ros2_standard.yaml:6:11: topics.joints: the log has several such topics: "
        "/a, /b; names: [...] says which");
  }
}

TEST(MappedRows, OptionalTopicsOfATypeAreNotGuessedAt) {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/lowstate", "unitree_go/msg/LowState");
  (void)log.AddChannel("/vicon/a/a", "vicon_receiver/msg/Position");
  (void)log.AddChannel("/vicon/b/b", "vicon_receiver/msg/Position");
  for (std::uint32_t i = 0; i < 5; ++i) log.Add(state, kStart_ns + i * kMs, LowState(i));
  const Mapped mapped = ReadRows(log);
  EXPECT_EQ(mapped.report.mapping, "unitree_go2");
  EXPECT_EQ(mapped.report.absent,
            (std::vector<std::string>{"lowcmd", "sport",
                                      "single vicon (/vicon/a/a, /vicon/b/b are there)"}));
  EXPECT_EQ(mapped.rows.size(), 5u);
}

// --- One type name, two layouts.

/// @param with_header  as the type is since 2025-11.
Bytes ViconPosition(std::int64_t time_ns, bool with_header, int frame) {
  CdrWriter out(kLittleEndian);
  if (with_header) WriteStamp(out, time_ns, "world");
  out.F32(static_cast<float>(2.0 * frame)).F32(-200.0f).F32(430.0f);
  out.F32(0.0f).F32(0.0f).F32(0.0f).F32(1.0f);
  out.Text("robot").Text("robot").U32(static_cast<std::uint64_t>(frame)).Text("vicon");
  return out.bytes();
}

TEST(MappedRows, LayoutsOfOneNameAreToldApart) {
  for (const bool with_header : {false, true}) {
    MemoryLog log;
    const std::size_t vicon = log.AddChannel("/vicon/robot/robot", "vicon_receiver/msg/Position");
    for (int i = 0; i < 100; ++i) {
      const std::int64_t sent_ns = kStart_ns + i * 5 * kMs;
      log.Add(vicon, sent_ns + (i % 3) * kMs, ViconPosition(sent_ns, with_header, i));
    }
    const Mapped mapped = ReadRows(log);
    EXPECT_EQ(mapped.report.mapping, "vicon_receiver");
    EXPECT_TRUE(mapped.report.truth_is_of_markers);
    EXPECT_EQ(mapped.report.topics[0].type.substr(0, 22),
              with_header ? "built in, with header" : "built in, without head");
    EXPECT_EQ(mapped.report.topics[0].clock.substr(0, 7), with_header ? "header " : "receive");
    ASSERT_EQ(mapped.rows.size(), 100u);
    const TruthRow& truth = *mapped.rows[50].truth;
    EXPECT_NEAR(truth.p_WB_m[0], 0.1, 1e-6);
    EXPECT_NEAR(truth.p_WB_m[2], 0.43, 1e-6);
    EXPECT_NEAR(truth.v_WB_mps[0], 0.4, with_header ? 1e-5 : 0.2);  // 2 mm in 5 ms
    EXPECT_TRUE(mapped.report.problems.empty());
  }
}

// --- The reference framework.

msg::QuadState QuadStateAt(std::int64_t time_ns) {
  msg::QuadState m;
  m.header.stamp = {static_cast<std::int32_t>(time_ns / 1'000'000'000),
                    static_cast<std::uint32_t>(time_ns % 1'000'000'000)};
  m.pose.pose.orientation = {0.0, 0.0, std::sin(std::numbers::pi / 4),
                             std::cos(std::numbers::pi / 4)};
  m.twist.twist.linear.x = 0.25;
  m.ground_contact_force[0] = 10.0;
  return m;
}

TEST(MappedRows, ContactForcesAreTurnedUnlessTheLogSaysTheyAreInTheWorld) {
  for (const bool says_world : {false, true}) {
    MemoryLog log;
    if (says_world) log.AddMetadata("scoria", {{"contact_force_frame", "W"}});
    const std::size_t state = log.AddChannel("/quad_state", "interfaces/msg/QuadState");
    for (int i = 0; i < 10; ++i)
      log.AddMessage(state, kStart_ns + i * kMs, QuadStateAt(kStart_ns + i * kMs));
    const Mapped mapped = ReadRows(log);
    EXPECT_EQ(mapped.report.mapping, "dfki_quad");
    const Array12& f = *mapped.rows[5].contacts->f_F_W_N;
    EXPECT_NEAR(f[0], says_world ? 10.0 : 0.0, 1e-9);
    EXPECT_NEAR(f[1], says_world ? 0.0 : 10.0, 1e-9);
    EXPECT_EQ(mapped.rows[5].estimate->v_WB_mps, (Array3{0.25, 0.0, 0.0}));  // in the world
  }
}

TEST(MappedRows, TopicsWithoutAHeaderAreShiftedToTheClockOfThoseWithOne) {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/quad_state", "interfaces/msg/QuadState"),
                    command =
                        log.AddChannel("/quad_control_target", "interfaces/msg/QuadControlTarget");
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now_ns = 1000 * kMs + i * kMs;  // of a simulation: its clock starts at 0
    const std::int64_t received_ns = kStart_ns + i * kMs;
    log.AddMessage(state, received_ns + (i % 4) * 100'000, QuadStateAt(now_ns));
    msg::QuadControlTarget target;
    target.body_x_dot = i < 500 ? 0.0 : 1.0;
    if (i % 10 == 0) log.AddMessage(command, received_ns, target);
  }
  const Mapped mapped = ReadRows(log);
  ASSERT_EQ(mapped.rows.size(), 1000u);
  EXPECT_FALSE(mapped.report.start_ns);  // not since 1970: times stay as they are
  EXPECT_DOUBLE_EQ(mapped.rows[0].time_s, 1.0);
  EXPECT_EQ(mapped.rows[490].command->v_x_mps, 0.0);
  EXPECT_EQ(mapped.rows[505].command->v_x_mps, 1.0);
}

TEST(MappedRows, WhatCannotBeDecodedIsCounted) {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/quad_state", "interfaces/msg/QuadState");
  for (int i = 0; i < 10; ++i)
    log.AddMessage(state, kStart_ns + i * kMs, QuadStateAt(kStart_ns + i * kMs));
  log.Add(state, kStart_ns + 10 * kMs, ZeroMessage(40));
  const Mapped mapped = ReadRows(log);
  EXPECT_TRUE(mapped.rows.empty());  // no built-in definition fits all messages
  ASSERT_EQ(mapped.report.problems.size(), 1u);
  EXPECT_TRUE(mapped.report.problems[0].what.starts_with(
      "/quad_state: none of its 11 messages can be decoded: no definition of "
      "interfaces/msg/QuadState fits: built in: "))
      << mapped.report.problems[0].what;
}

TEST(MappedRows, PerJointSignsZerosUnitsAndOrderAreUndone) {
  MemoryLog log;
  const std::size_t data = log.AddChannel("/data", "interfaces/msg/JointState");
  msg::JointState m;
  for (std::size_t i = 0; i < 12; ++i) m.position[i] = m.velocity[i] = static_cast<double>(i);
  for (int i = 0; i < 5; ++i) log.AddMessage(data, kStart_ns + i * kMs, m);
  const Mapping mapping = ParseMapping(R"(
legs: [RR, RL, FR, FL]
joints:
  order: by_joint
  sign: {all: [1, -1, 1], hind: [-1, -1, 1], FR: [1, 1, 1]}
  zero_rad: {left: [0.5, 0, 0]}
  q: {field: position, unit: deg, scale: 2}
  qd: velocity
)",
                                       "m.yaml");
  std::vector<Row> rows;
  ForEachMappedRow(log, mapping, TypeResolver(), [&](const Row& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 5u);
  const auto place = [](std::size_t leg, std::size_t joint) {  // RR RL FR FL, joint by joint
    constexpr std::array<double, 4> kPlace = {3, 2, 1, 0};
    return 4.0 * static_cast<double>(joint) + kPlace[leg];
  };
  constexpr double kSigns[4][3] = {{1, -1, 1}, {1, 1, 1}, {-1, -1, 1}, {-1, -1, 1}};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double zero = leg % 2 == 0 && j == 0 ? 0.5 : 0.0;
      EXPECT_NEAR((*rows[2].measured->q_rad)[3 * leg + j],
                  kSigns[leg][j] * place(leg, j) * 2.0 * std::numbers::pi / 180.0 + zero, 1e-12);
      EXPECT_EQ((*rows[2].measured->qd_radps)[3 * leg + j], kSigns[leg][j] * place(leg, j));
    }
  }
}

TEST(MappedRows, FieldsThatTheTypeHasNotAreNamed) {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/quad_state", "interfaces/msg/QuadState");
  log.AddMessage(state, kStart_ns, QuadStateAt(kStart_ns));
  const auto error_of = [&](const std::string& yaml) -> std::string {
    try {
      ForEachMappedRow(log, ParseMapping(yaml, "m.yaml"), TypeResolver(), [](const Row&) {});
    } catch (const core::ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("joints: {q: joint_state.position}\n"), "");
  EXPECT_EQ(error_of("joints: {q: joint_stat.position}\n"),
            "m.yaml:1:13: joints.q: /quad_state: joint_stat.position: interfaces/msg/QuadState has "
            "no field \"joint_stat\" (did you mean \"joint_state\"?)");
  EXPECT_EQ(error_of("joints: {q: foot_contact}\n"),
            "m.yaml:1:13: joints.q: /quad_state: foot_contact: has 4 elements, 12 are needed");
  EXPECT_EQ(error_of("battery: {voltage: joint_state.position}\n"),
            "m.yaml:1:20: battery.voltage: /quad_state: joint_state.position: has 12 elements; one "
            "number is needed, such as joint_state.position[0]");
  EXPECT_EQ(error_of("battery: {voltage: header.frame_id}\n"),
            "m.yaml:1:20: battery.voltage: /quad_state: header.frame_id: is text, not a number");
  EXPECT_EQ(
      error_of("topics: {s: {type: interfaces/msg/QuadStat}}\njoints: {q: joint_state.position}\n"),
      "m.yaml:1:13: topics.s: the log has no topic of type interfaces/msg/QuadStat (did you "
      "mean \"interfaces/msg/QuadState\"?)");
}

}  // namespace
}  // namespace scoria::logs
