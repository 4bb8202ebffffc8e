// SPDX-License-Identifier: BSD-3-Clause
// What the READMEs of other teams' recordings say is wrong with them, found by the checks.
#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "logs/format/open_log.h"
#include "logs/quality/message_check.h"
#include "tests/logs/quality/defects.h"
#include "tests/logs/quality/quality_logs.h"
#include "tests/support/mini_cheetah.h"
#include "tests/support/robots.h"

namespace scoria::test {
namespace {

using logs::Finding;
using logs::FindingKind;

/// The text of a shipped mapping without the parts that match; the whole if there are none.
std::string MappingWithout(const std::string& name, const std::string& part) {
  std::ifstream file(SourcePath("mappings/" + name + ".yaml"));
  std::stringstream text;
  text << file.rdbuf();
  return std::regex_replace(text.str(), std::regex(part), "");
}

struct RecordedCase {
  std::string name, log;
  std::string mapping, without = {};  // what is taken out of that mapping; empty: as it is shipped
  Expected expected;
  bool is_there = true;
};

const RecordedCase kCases[] = {
    {"SwappedFeetOfWalking5",
     "go2_entangle_lowstate/walking5.csv",
     "go2_lowstate_csv",
     {},
     {.kind = FindingKind::kFootSensorOrder,
      .words = "FL from FR, FR from FL, HL from HR, HR from HL"}},
    {"SwappedFeetOfBackRightWire",
     "go2_entangle_lowstate/back_right_wire1.csv",
     "go2_lowstate_csv",
     {},
     {.kind = FindingKind::kFootSensorOrder,
      .words = "FL from FR, FR from FL, HL from HR, HR from HL"}},
    {"SwappedFeetOfFrontRightWire",
     "go2_entangle_lowstate/go2_lowstate_entaglement_front_right_wire.csv",
     "go2_lowstate_csv",
     {},
     {.kind = FindingKind::kFootSensorOrder,
      .words = "FL from FR, FR from FL, HL from HR, HR from HL"}},
    {"NoSwappedFeetOfGo1",
     "go1_sim_trot_mpi/go1_trot_1khz.csv",
     "go1_sim_csv",
     {},
     {.kind = FindingKind::kFootSensorOrder},
     false},
    {"LongestGapOfTest4",
     "go2_vicon_orl/test_4",
     "go2_vicon_csv",
     {},
     {.kind = FindingKind::kGap, .size = 0.6076, .size_within = 0.00005}},
    {"MillimetresOfTest4",
     "go2_vicon_orl/test_4",
     "go2_vicon_csv",
     ", unit: mm",
     {.kind = FindingKind::kMillimetres, .signal = "truth.position", .words = "unit: mm"}},
    {"SignOfSpiritsAcceleration",
     "spirit40_imu_flipped/test2.csv",
     "ros1_imu_csv",
     ", axes: \\[\"y\", x, -z\\]",
     {.kind = FindingKind::kGravitySign, .words = "[y, x, -z]"}},
    {"AxesOfSpiritsGyroscope",
     "spirit40_imu_flipped/test2.csv",
     "ros1_imu_csv",
     ", axes: \\[\"y\", x, -z\\]",
     {.kind = FindingKind::kAttitudeSign,
      .signal = "imu.attitude",
      .words = "imu.rate, imu.acceleration: axes [y, x, -z]"}},
    {"NoAxesOfSpiritsGyroscopeByItsMapping",
     "spirit40_imu_flipped/test2.csv",
     "ros1_imu_csv",
     {},
     {.kind = FindingKind::kAttitudeSign, .signal = "imu.attitude"},
     false},
    {"NoSignOfSpiritsAccelerationByItsMapping",
     "spirit40_imu_flipped/test2.csv",
     "ros1_imu_csv",
     {},
     {.kind = FindingKind::kGravitySign},
     false},
    {"OffsetOfMiniCheetahsFrontHip",
     "minicheetah_raisim/flat_fwd_minus_0_4.csv",
     "mini_cheetah_raisim_csv",
     "  (sign|zero_rad):[^\n]*\n",
     {.kind = FindingKind::kJointOffset,
      .leg = Leg::kFL,
      .joint = Joint::kHFE,
      .size = -1.5708,
      .size_within = 1e-3,
      .words = "zero_rad: +1.5708"}},
    {"OffsetOfMiniCheetahsHindHip",
     "minicheetah_raisim/flat_fwd_minus_0_4.csv",
     "mini_cheetah_raisim_csv",
     "  (sign|zero_rad):[^\n]*\n",
     {.kind = FindingKind::kJointOffset,
      .leg = Leg::kHR,
      .joint = Joint::kHFE,
      .size = 1.5708,
      .size_within = 1e-3,
      .words = "zero_rad: -1.5708"}},
    {"MiniCheetahWalksBackwards",
     "minicheetah_raisim/flat_fwd_minus_0_4.csv",
     "mini_cheetah_raisim_csv",
     {},
     {.kind = FindingKind::kWalksBackwards, .size = 7.0, .size_within = 0.15}},
};

class RecordedLogs : public testing::TestWithParam<RecordedCase> {};

TEST_P(RecordedLogs, IsFound) {
  const RecordedCase& c = GetParam();
  if (!RecordedLog(c.log)) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::string text = c.without.empty() ? "" : MappingWithout(c.mapping, c.without);
  const core::RobotDescription cheetah = MakeMiniCheetah();
  const core::RobotDescription* robot = &Go2();
  if (c.log.starts_with("mini")) robot = &cheetah;
  if (c.log.starts_with("spirit")) robot = nullptr;
  const std::vector<Finding> findings = Judge(ReadRecordedLog({c.log}, text), robot);
  std::string all;
  for (const Finding& f : findings) all += "\n" + DescribeFinding(f);
  EXPECT_EQ(std::any_of(findings.begin(), findings.end(),
                        [&](const Finding& f) { return Names(f, c.expected); }),
            c.is_there)
      << all;
}

INSTANTIATE_TEST_SUITE_P(Of, RecordedLogs, testing::ValuesIn(kCases),
                         [](const auto& test_info) { return test_info.param.name; });

TEST(RecordedLogs, RobotThatLiesAndGetsUpHasNoWrongJoints) {
  if (!RecordedLog("")) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::vector<logs::Row> rows = ReadRecordedLog({"go2_vicon_orl/test_4"});
  for (const Finding& f : Judge(Window(rows, 0), &Go2()))
    EXPECT_NE(f.severity, logs::Severity::kError) << DescribeFinding(f);
}

std::vector<Finding> MessageFindings(const std::string& name) {
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(*RecordedLog(name));
  return logs::JudgeMessages(*log, logs::TypeResolver());
}

TEST(RecordedMessages, LostFramesOfTest6AreCounted) {
  if (!RecordedLog("")) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::vector<Finding> findings = MessageFindings("go2_vicon_orl/test_6_vicon_bag");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, FindingKind::kLostMessages);
  EXPECT_EQ(findings[0].count, 126u);
  EXPECT_NE(findings[0].evidence.find("by frame_number in 51 holes"), std::string::npos)
      << findings[0].evidence;
}

TEST(RecordedMessages, SpiritsStampsAreRegularAndItsTimesOfRecordingAreNot) {
  if (!RecordedLog("")) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::vector<Finding> findings = MessageFindings("spirit40_imu_flipped/test2.csv");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, FindingKind::kReceiveTimes);
  EXPECT_NEAR(findings[0].size.value(), 0.99, 0.05);
  EXPECT_EQ(findings[0].repair, "mapping: time: {clock: header}");
}

}  // namespace
}  // namespace scoria::test
