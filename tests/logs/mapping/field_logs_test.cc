// SPDX-License-Identifier: BSD-3-Clause
// Recordings of other teams become rows by shipped mappings that are chosen by themselves; what
// their READMEs measured is in the rows.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <optional>

#include <gtest/gtest.h>

#include "core/files.h"
#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/load.h"
#include "logs/format/csv_log.h"
#include "logs/format/open_log.h"
#include "logs/mapping/any_rows.h"
#include "logs/mapping/choose_mapping.h"
#include "logs/vectors.h"
#include "tests/support/go1_log.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

struct MappedTestLog {
  std::vector<Row> rows;
  MappingReport report;
};

/// The rows of a file or files below the folder of recordings.
MappedTestLog ReadRows(const std::vector<std::string>& names) {
  std::vector<fs::path> paths;
  for (const std::string& name : names)
    paths.push_back(fs::path(std::getenv("SCORIA_REFERENCE_DATA")) / "logs" / name);
  MappedTestLog log;
  const RowsReport report = ForEachRow(paths, {}, [&](const Row& row) { log.rows.push_back(row); });
  log.report = report.mapping.value();
  return log;
}

class FieldLogs : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("SCORIA_REFERENCE_DATA") == nullptr)
      GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  }
};

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// The forces of the ground that torques tell, in B: f = -J^-T tau, of massless legs.
LegArray<Vec3> FootForces(const core::RobotDescription& robot, const Row& row) {
  const LegArray<Vec3> q = Unflatten(*row.measured->q_rad), tau = Unflatten(*row.measured->tau_Nm);
  LegArray<Vec3> forces = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    const Mat3 J = core::CalcLegKinematics(robot.legs[leg], q[leg]).J;
    forces[leg] = -J.transpose().inverse() * tau[leg];
  }
  return forces;
}

/// Sum of the vertical forces in the world, N.
double SumFz(const core::RobotDescription& robot, const Row& row) {
  const Mat3 R_WB = row.measured->rpy_WS_rad
                        ? core::RotationFromRpy(ToVec3(*row.measured->rpy_WS_rad))
                        : Mat3(Mat3::Identity());
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : FootForces(robot, row)) sum += f;
  return (R_WB * sum).z();
}

std::vector<double> SumsFz(const core::RobotDescription& robot, const std::vector<Row>& rows) {
  std::vector<double> sums;
  for (const Row& row : rows) sums.push_back(SumFz(robot, row));
  return sums;
}

/// Median length of the specific force, m/s².
double MedianAcceleration(const std::vector<Row>& rows) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(ToVec3(*row.measured->a_WS_S_mps2).norm());
  return Quantile(values, 0.5);
}

/// Largest difference between rates of joints and derivatives of their angles, as a share.
double SlopeOfRates(const std::vector<Row>& rows) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const double dt_s = rows[i + 1].time_s - rows[i - 1].time_s;
    for (std::size_t k = 0; k < 12; ++k) {
      const double qd = (*rows[i].measured->qd_radps)[k];
      const double slope =
          ((*rows[i + 1].measured->q_rad)[k] - (*rows[i - 1].measured->q_rad)[k]) / dt_s;
      products += qd * slope;
      squares += slope * slope;
    }
  }
  return products / squares;
}

double Correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = Mean(a), mean_b = Mean(b);
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

TEST_F(FieldLogs, SimulatedGo1HasItsMassAndBodyTwist) {
  const MappedTestLog log = ReadRows({"go1_sim_trot_mpi/go1_trot_1khz.csv"});
  EXPECT_EQ(log.report.mapping, "go1_sim_csv");
  ASSERT_EQ(log.rows.size(), 5000u);
  const core::RobotDescription go1 = test::LoadGo1(*test::Go1Folder());
  const std::vector<test::LogTick> ticks = test::ReadGo1Log(*test::Go1Folder(), go1);
  std::vector<double> forces;
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const Row& row = log.rows[i];
    const test::LogTick& tick = ticks[i];  // read by a parser of its own
    EXPECT_NEAR(row.time_s, 1e-3 * static_cast<double>(i), 1e-9);
    EXPECT_LT((ToVec3(row.truth->v_WB_mps) - tick.state.v_WB).norm(), 1e-9);
    EXPECT_LT((ToVec3(row.truth->w_WB_radps) - tick.state.w_WB).norm(), 1e-9);
    EXPECT_LT((core::RotationFromRpy(ToVec3(row.truth->rpy_rad)) - tick.state.R_WB).norm(), 1e-9);
    EXPECT_EQ(*row.measured->q_rad, Flatten(tick.state.q));
    EXPECT_EQ(*row.measured->tau_Nm, Flatten(tick.z.tau_Nm));
    EXPECT_EQ(*row.true_contacts->f_F_W_N, Flatten(tick.f_F_W));
    const Array12& f = *row.true_contacts->f_F_W_N;
    forces.push_back(f[2] + f[5] + f[8] + f[11]);
    EXPECT_EQ(row.true_contacts->contact[0], tick.contact[Leg::kFL]);
  }
  EXPECT_NEAR(Mean(forces), 138.79, 0.01);
  const double speed =
      (ToVec3(log.rows.back().truth->p_WB_m) - ToVec3(log.rows[1000].truth->p_WB_m)).norm() / 3.999;
  EXPECT_NEAR(speed, 0.415, 0.02);
}

TEST_F(FieldLogs, EntangledGo2KeepsTheNamesOfItsFeet) {
  struct Walk {
    const char* file;
    double sum_fz_N, gap_ms;
  };
  for (const Walk& walk :
       {Walk{"walking5.csv", 171.9, 18.6}, Walk{"back_right_wire1.csv", 194.2, 18.6},
        Walk{"go2_lowstate_entaglement_front_right_wire.csv", 198.0, 3.0}}) {
    const MappedTestLog log = ReadRows({std::string("go2_entangle_lowstate/") + walk.file});
    EXPECT_EQ(log.report.mapping, "go2_lowstate_csv");
    EXPECT_TRUE(log.report.robot.string().ends_with("robots/go2/go2.yaml")) << log.report.robot;
    EXPECT_TRUE(log.report.start_ns.has_value());
    EXPECT_EQ(log.rows.front().time_s, 0.0);
    const std::vector<double> sums = SumsFz(test::Go2(), log.rows);
    EXPECT_NEAR(Mean(sums), walk.sum_fz_N, 1.5) << walk.file;
    EXPECT_NEAR(MedianAcceleration(log.rows), 9.7, 0.5);
    double largest_gap_s = 0.0;
    for (std::size_t i = 1; i < log.rows.size(); ++i)
      largest_gap_s = std::max(largest_gap_s, log.rows[i].time_s - log.rows[i - 1].time_s);
    EXPECT_LT(1e3 * largest_gap_s, walk.gap_ms + 1.0) << walk.file;
    // The columns are mislabelled at the source: FL follows the force of FR. No mapping hides that.
    std::vector<double> counts, own, other;
    for (const Row& row : log.rows) {
      const LegArray<Vec3> forces = FootForces(test::Go2(), row);
      counts.push_back((*row.measured->foot_force_counts)[0]);
      own.push_back(forces[Leg::kFL].z());
      other.push_back(forces[Leg::kFR].z());
    }
    EXPECT_GT(Correlation(counts, other), Correlation(counts, own) + 0.3) << walk.file;
  }
}

TEST_F(FieldLogs, Go2WithoutImuStandsUp) {
  const MappedTestLog log = ReadRows({"go2_joints_only_91hz/go2_walking.csv"});
  EXPECT_EQ(log.report.mapping, "go2py_csv");
  ASSERT_EQ(log.rows.size(), 5000u);
  EXPECT_FALSE(log.rows[0].measured->a_WS_S_mps2);
  EXPECT_FALSE(log.rows[0].truth || log.rows[0].estimate);
  EXPECT_NEAR(log.rows.back().time_s, 55.0, 1.0);
  const std::vector<double> sums = SumsFz(test::Go2(), log.rows);
  EXPECT_NEAR(Quantile(sums, 0.25), 105.6, 5.0);
  EXPECT_NEAR(Quantile(sums, 0.5), 177.6, 5.0);
  EXPECT_NEAR(Quantile(sums, 0.75), 214.2, 5.0);
  EXPECT_NEAR(sums.front(), 0.0, 10.0);  // it lies
}

TEST_F(FieldLogs, AccelerometerWithoutGravityGetsItBack) {
  const MappedTestLog log = ReadRows({"go2_mujoco_serow/go2_walk.csv"});
  EXPECT_EQ(log.report.mapping, "go2_mujoco_csv");
  ASSERT_EQ(log.rows.size(), 4090u);
  EXPECT_FALSE(log.rows[0].measured->tau_Nm);
  std::vector<double> z;
  for (const Row& row : log.rows) z.push_back((*row.measured->a_WS_S_mps2)[2]);
  EXPECT_NEAR(Mean(z), 9.81, 0.5);
  EXPECT_LT(z.front(), 0.0);  // it falls
  EXPECT_NEAR(log.rows.back().truth->p_WB_m[0], 2.54, 0.005);
  // The velocity that the log has not.
  double distance_m = 0.0;
  const Row* before = nullptr;
  for (const Row& row : log.rows) {
    if (!row.truth) continue;
    if (before != nullptr)
      distance_m += 0.5 * (row.truth->v_WB_mps[0] + before->truth->v_WB_mps[0]) *
                    (row.time_s - before->time_s);
    before = &row;
  }
  EXPECT_NEAR(distance_m, 2.54, 0.02);
}

TEST_F(FieldLogs, ViconBesideALowStateIsJoined) {
  const MappedTestLog log = ReadRows({"go2_vicon_orl/test_4"});
  EXPECT_EQ(log.report.mapping, "go2_vicon_csv");
  EXPECT_EQ(log.report.base_topic, "state_history");
  EXPECT_TRUE(log.report.truth_is_of_markers);
  ASSERT_EQ(log.rows.size(), 7143u);
  double largest_gap_s = 0.0, turned_rad = 0.0, gyro_rad = 0.0, yaw_rad = 0.0;
  std::vector<double> walking;
  int with_truth = 0, commanded = 0;
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const Row& row = log.rows[i];
    const double dt_s = i == 0 ? 0.0 : row.time_s - log.rows[i - 1].time_s;
    largest_gap_s = std::max(largest_gap_s, dt_s);
    gyro_rad += (*row.measured->w_WS_S_radps)[2] * dt_s;
    const double sum_fz_N = SumFz(test::Go2(), row);
    if (row.time_s > 9.0 && row.time_s < 31.0) walking.push_back(sum_fz_N);
    if (row.joint_command && row.joint_command->q_rad) {
      ++commanded;
      EXPECT_LT(std::abs((*row.joint_command->q_rad)[0]), 3.0);
    }
    if (!row.truth) continue;
    if (with_truth++ > 0) turned_rad += core::WrapToPi(row.truth->rpy_rad[2] - yaw_rad);
    yaw_rad = row.truth->rpy_rad[2];
  }
  EXPECT_NEAR(1e3 * largest_gap_s, 607.6, 0.1);
  EXPECT_NEAR(Mean(walking), 164.5, 3.0);
  EXPECT_NEAR(gyro_rad * 180.0 / M_PI, 1069.0, 50.0);  // over gaps: it goes by how one sums
  EXPECT_NEAR(turned_rad * 180.0 / M_PI, 1088.0, 15.0);
  EXPECT_GT(with_truth, 6500);
  EXPECT_FALSE(log.rows[0].joint_command && log.rows[0].joint_command->q_rad);  // 2.146e9
  EXPECT_GT(commanded, 1000);
  // Metres, of a standing robot's markers: 0.43.
  std::vector<double> heights;
  for (const Row& row : log.rows) {
    if (row.truth && row.time_s > 9.0 && row.time_s < 31.0) heights.push_back(row.truth->p_WB_m[2]);
  }
  EXPECT_NEAR(Quantile(heights, 0.5), 0.43, 0.02);
  EXPECT_NEAR(log.rows[0].measured->a_WS_S_mps2->at(2), 9.51, 0.01);
}

/// A database of Humble, without definitions; beside it what its authors made of it.
TEST_F(FieldLogs, ViconBagHasTheValuesOfItsExport) {
  const MappedTestLog log = ReadRows({"go2_vicon_orl/test_6_vicon_bag"});
  EXPECT_EQ(log.report.mapping, "vicon_receiver");
  EXPECT_TRUE(log.report.topics[0].type.starts_with("built in, with header"));
  EXPECT_TRUE(log.report.topics[0].clock.starts_with("header ")) << log.report.topics[0].clock;
  std::ifstream csv(fs::path(std::getenv("SCORIA_REFERENCE_DATA")) /
                    "logs/go2_vicon_orl/test_6_vicon_bag/vicon_history.csv");
  ASSERT_EQ(log.rows.size(), 7396u);
  CsvSplitter splitter(',');
  int num_places = 0;
  for (const Row& row : log.rows) {
    std::string line;
    ASSERT_TRUE(std::getline(csv, line));
    const auto fields = splitter.Split(line);
    const auto number = [&](std::size_t column) { return ParseCsvNumber(fields[column]).value(); };
    const std::int64_t stamp_ns = ParseCsvTime(fields[0], 1).value() - log.report.start_ns.value();
    EXPECT_NEAR(row.time_s, 1e-9 * static_cast<double>(stamp_ns), 1e-9);
    if (!row.truth) continue;  // alone between two gaps: without a velocity
    ++num_places;
    const Mat3 R_WB =
        Quat(number(4), number(5), number(6), number(7)).normalized().toRotationMatrix();
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(row.truth->p_WB_m[k], 1e-3 * number(1 + k), 1e-5);  // six digits
    EXPECT_LT((core::RotationFromRpy(ToVec3(row.truth->rpy_rad)) - R_WB).norm(), 1e-4);
  }
  EXPECT_GT(num_places, 7380);
}

TEST_F(FieldLogs, MiniCheetahWalksBackwardsWithItsHipsZeroed) {
  const MappedTestLog log = ReadRows({"minicheetah_raisim/flat_fwd_minus_0_4.csv"});
  EXPECT_EQ(log.report.mapping, "mini_cheetah_raisim_csv");
  ASSERT_EQ(log.rows.size(), 7771u);
  const Array12& q = *log.rows[0].measured->q_rad;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_NEAR(q[3 * leg], 0.0, 1e-4);
    EXPECT_NEAR(q[3 * leg + 1], -1.0, 1e-4);
    EXPECT_NEAR(q[3 * leg + 2], 1.9, 1e-4);  // knees forward
  }
  double path_m = 0.0;
  for (std::size_t i = 1; i < log.rows.size(); ++i)
    path_m += (ToVec3(log.rows[i].truth->p_WB_m) - ToVec3(log.rows[i - 1].truth->p_WB_m))
                  .head<2>()
                  .norm();
  EXPECT_NEAR(path_m, 7.09, 0.01);
  EXPECT_LT(log.rows.back().truth->p_WB_m[0], -6.9);
  EXPECT_NEAR(SlopeOfRates(log.rows), 1.0, 0.02);
  std::vector<double> v, dp;
  for (std::size_t i = 1; i + 1 < log.rows.size(); ++i) {
    v.push_back(log.rows[i].truth->v_WB_mps[0]);
    dp.push_back((log.rows[i + 1].truth->p_WB_m[0] - log.rows[i - 1].truth->p_WB_m[0]) /
                 (log.rows[i + 1].time_s - log.rows[i - 1].time_s));
  }
  EXPECT_NEAR(Mean(v), Mean(dp), 1e-3);
  EXPECT_GT(Correlation(v, dp), 0.999);
}

TEST_F(FieldLogs, SpiritGoesByItsHeaderAndItsFlippedAccelerometerIsTurned) {
  const MappedTestLog log = ReadRows({"spirit40_imu_flipped/test2.csv"});
  EXPECT_EQ(log.report.mapping, "ros1_imu_csv");
  ASSERT_EQ(log.rows.size(), 3053u);
  EXPECT_TRUE(log.report.topics[0].clock.starts_with("header (steps of 10 ms, irregularity 0.0"))
      << log.report.topics[0].clock;
  const std::string page = core::ReadText(test::SourcePath("docs/mappings.md"));
  EXPECT_NE(page.find("\n" + log.report.topics[0].clock + "\n"), std::string::npos)
      << log.report.topics[0].clock;
  std::vector<double> steps, z;
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    if (i > 0) steps.push_back(log.rows[i].time_s - log.rows[i - 1].time_s);
    z.push_back((*log.rows[i].measured->a_WS_S_mps2)[2]);
  }
  EXPECT_NEAR(Mean(z), 9.826, 1e-3);
  EXPECT_NEAR(Quantile(steps, 0.01), 9.6e-3, 0.1e-3);
  EXPECT_NEAR(Quantile(steps, 0.99), 10.4e-3, 0.1e-3);
  EXPECT_NEAR(log.rows.back().time_s, 30.5, 0.2);  // the times of recording span 29.5 s
  EXPECT_NEAR((*log.rows[0].measured->rpy_WS_rad)[0], 0.0, 0.05);
}

}  // namespace
}  // namespace scoria::logs
