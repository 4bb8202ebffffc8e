// SPDX-License-Identifier: BSD-3-Clause
// Drafts of logs whose shipped mapping is known: what both give is the same.
#include "logs/mapping/draft_mapping.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "logs/format/open_log.h"
#include "logs/mapping/choose_mapping.h"
#include "logs/mapping/mapped_rows.h"
#include "tests/logs/mapping/field_messages.h"
#include "tests/support/memory_log.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

std::vector<Row> RowsOf(LogSource& log, const Mapping& mapping) {
  std::vector<Row> rows;
  ForEachMappedRow(log, mapping, TypeResolver(), [&](const Row& row) { rows.push_back(row); });
  return rows;
}

class Drafts : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("SCORIA_REFERENCE_DATA") == nullptr)
      GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  }
  static std::unique_ptr<LogSource> Open(const std::string& name) {
    return OpenLog(fs::path(std::getenv("SCORIA_REFERENCE_DATA")) / "logs" / name);
  }
};

/// Nine logs in ten have names: then the draft says of sensors what the shipped mapping says.
TEST_F(Drafts, OfNamedColumnsMeasureTheSame) {
  for (const char* name :
       {"go1_sim_trot_mpi/go1_trot_1khz.csv", "go2_entangle_lowstate/walking5.csv",
        "go2_joints_only_91hz/go2_walking.csv", "go2_mujoco_serow/go2_walk.csv"}) {
    const auto log = Open(name);
    const std::string text = DraftMapping(*log, TypeResolver());
    const std::vector<Row> drafted = RowsOf(*log, ParseMapping(text, "draft.yaml"));
    const std::vector<Row> shipped =
        RowsOf(*log, ChooseMapping(log->contents(), ShippedMappings()));
    ASSERT_EQ(drafted.size(), shipped.size()) << text;
    for (std::size_t i = 0; i < drafted.size(); ++i)
      ASSERT_TRUE(drafted[i].measured == shipped[i].measured) << name << " row " << i << "\n"
                                                              << text;
  }
}

/// What no name tells: the hips' zeros. The rest is right.
TEST_F(Drafts, OfMiniCheetahLacksItsZerosAndSigns) {
  const auto log = Open("minicheetah_raisim/flat_fwd_minus_0_4.csv");
  const std::vector<Row> drafted =
      RowsOf(*log, ParseMapping(DraftMapping(*log, TypeResolver()), "draft.yaml"));
  const std::vector<Row> shipped = RowsOf(*log, ChooseMapping(log->contents(), ShippedMappings()));
  const Array12 &a = *drafted[0].measured->q_rad, &b = *shipped[0].measured->q_rad;
  for (std::size_t k = 0; k < 12; ++k) {
    const double sign = k % 3 == 0 ? 1.0 : -1.0;  // of HFE and KFE
    EXPECT_NEAR(std::abs(b[k] - sign * a[k]), k % 3 == 1 ? M_PI / 2 : 0.0, 1e-9);
  }
  EXPECT_EQ(drafted[100].truth->p_WB_m, shipped[100].truth->p_WB_m);
  EXPECT_EQ(drafted[100].truth->v_WB_mps, shipped[100].truth->v_WB_mps);
}

TEST_F(Drafts, TurnAnAccelerometerThatShowsThePullOfGravity) {
  const auto log = Open("spirit40_imu_flipped/test2.csv");
  const std::string text = DraftMapping(*log, TypeResolver());
  const std::vector<Row> rows = RowsOf(*log, ParseMapping(text, "draft.yaml"));
  double sum = 0.0;
  for (const Row& row : rows) sum += (*row.measured->a_WS_S_mps2)[2];
  EXPECT_NEAR(sum / static_cast<double>(rows.size()), 9.826, 0.01);
  EXPECT_TRUE(rows[0].measured->w_WS_S_radps && rows[0].measured->rpy_WS_rad) << text;
}

/// Tables without names are told by knees, derivatives and lengths. The order of the legs is not.
TEST_F(Drafts, OfTablesWithoutNamesGoByTheNumbers) {
  const auto log = Open("go2_vicon_orl/test_4");
  const std::string text = DraftMapping(*log, TypeResolver());
  std::string draft = text;
  const std::string guess =
      "legs: [FL, FR, HL, HR]  # the log does not name them: in the order of "
      "its arrays\n";
  const std::size_t at = draft.find(guess);
  ASSERT_NE(at, std::string::npos) << text;
  draft.replace(at, guess.size(), "legs: [FR, FL, RR, RL]\n");  // what the user knows
  const std::vector<Row> drafted = RowsOf(*log, ParseMapping(draft, "draft.yaml"));
  const std::vector<Row> shipped = RowsOf(*log, ChooseMapping(log->contents(), ShippedMappings()));
  ASSERT_EQ(drafted.size(), shipped.size()) << text;
  for (std::size_t i = 0; i < drafted.size(); ++i) {
    ASSERT_TRUE(drafted[i].measured == shipped[i].measured) << text;
    ASSERT_TRUE(drafted[i].truth == shipped[i].truth) << text;
  }
  EXPECT_NE(text.find("# nothing recognised in command_history"), std::string::npos) << text;
}

TEST(Draft, OfUnitreeMessagesIsNearTheShippedMapping) {
  test::MemoryLog log;
  const std::size_t state = log.AddChannel("/lowstate", "unitree_go/msg/LowState");
  for (int i = 0; i < 20; ++i)
    log.Add(state, test::kRecordingStart_ns + i * 2'000'000,
            test::LowState(static_cast<std::uint32_t>(2 * i)));
  const std::string text = DraftMapping(log, TypeResolver());
  const std::vector<Row> drafted = RowsOf(log, ParseMapping(text, "draft.yaml"));
  const std::vector<Row> shipped = RowsOf(log, FindMapping("unitree_go2"));
  ASSERT_EQ(drafted.size(), 20u);
  EXPECT_EQ(drafted[5].measured->q_rad, shipped[5].measured->q_rad) << text;
  EXPECT_EQ(drafted[5].measured->qd_radps, shipped[5].measured->qd_radps) << text;
  EXPECT_EQ(drafted[5].measured->tau_Nm, shipped[5].measured->tau_Nm) << text;
  EXPECT_EQ(drafted[5].measured->rpy_WS_rad, shipped[5].measured->rpy_WS_rad) << text;
  EXPECT_EQ(drafted[5].measured->a_WS_S_mps2, shipped[5].measured->a_WS_S_mps2) << text;
  EXPECT_NE(text.find("# The shipped mapping unitree_go2 fits this log.\n"), std::string::npos);
}

TEST(Draft, OfJointStatesGoesByTheirNames) {
  test::MemoryLog log;
  const std::size_t joints = log.AddChannel("/joint_states", "sensor_msgs/msg/JointState");
  std::vector<std::string> names;
  for (const char* leg : {"lf", "rf", "lh", "rh"}) {
    for (const char* joint : {"hip", "upper_leg", "lower_leg"})
      names.push_back(std::string(leg) + "_" + joint + "_joint");
  }
  std::vector<double> values(12);
  for (std::size_t k = 0; k < 12; ++k) values[k] = 0.1 * static_cast<double>(k);
  for (int i = 0; i < 20; ++i) {
    const std::int64_t time_ns = test::kRecordingStart_ns + i * 10'000'000;
    log.Add(joints, time_ns, test::JointState(time_ns, names, values));
  }
  const std::string text = DraftMapping(log, TypeResolver());
  const std::vector<Row> drafted = RowsOf(log, ParseMapping(text, "draft.yaml"));
  EXPECT_TRUE(drafted[5].measured == RowsOf(log, FindMapping("ros2_standard"))[5].measured) << text;
}

}  // namespace
}  // namespace scoria::logs
