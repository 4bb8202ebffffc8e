// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/accept.h"

#include <gtest/gtest.h>

namespace scoria::app {
namespace {

using logs::Finding;
using logs::FindingKind;
using logs::Severity;

constexpr const char* kMapping = R"(
name: sample
topics: {imu: {type: sensor_msgs/msg/Imu}}
imu: {topic: imu, rate: angular_velocity, acceleration: linear_acceleration}
)";

Finding WithRepair(FindingKind kind, const std::string& repair) {
  Finding finding;
  finding.severity = Severity::kError;
  finding.kind = kind;
  finding.signal = "imu.acceleration";
  finding.repair = repair;
  return finding;
}

std::string MessageOf(const std::vector<std::string>& kinds, const std::vector<Finding>& findings) {
  const logs::Mapping mapping = logs::ParseMapping(kMapping, "sample.yaml");
  try {
    (void)Accept(kinds, findings, &mapping);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Accept, RepairIsMadeInTheMapping) {
  const logs::Mapping mapping = logs::ParseMapping(kMapping, "sample.yaml");
  const Accepted accepted = Accept(
      {"gravity_unit"},
      {WithRepair(FindingKind::kGravityUnit, "mapping: imu.acceleration: {unit: g}"),
       WithRepair(FindingKind::kGravityMissing, "mapping: imu.acceleration: {gravity: removed}")},
      &mapping);
  ASSERT_TRUE(accepted.mapping);
  const auto& source = accepted.mapping->file().imu->acceleration;
  EXPECT_EQ(source->field, "linear_acceleration");
  EXPECT_NE(source->unit, mapping.file().imu->acceleration->unit);
  EXPECT_EQ(source->gravity, logs::Gravity::kIncluded) << "it was not accepted";
  ASSERT_EQ(accepted.remarks.size(), 1U);
  EXPECT_EQ(accepted.remarks[0],
            "gravity_unit of imu.acceleration: accepted; read by imu.acceleration: {unit: g}");
}

TEST(Accept, SpansOfWhatNoKeyRepairsAreLeftOut) {
  Finding stuck;
  stuck.kind = FindingKind::kStuckSensor;
  stuck.signal = "joints.q";
  stuck.spans = {{1.0, 3.0}};
  const Accepted accepted = Accept({"stuck_sensor"}, {stuck}, nullptr);
  EXPECT_FALSE(accepted.mapping);
  EXPECT_EQ(accepted.left_out, stuck.spans);
  EXPECT_EQ(accepted.remarks.at(0), "stuck_sensor of joints.q: accepted; 1 span of time left out");
}

TEST(Accept, RefusesWhatItCannotDoAndUnknownNames) {
  EXPECT_EQ(MessageOf({"gravity_unti"}, {}),
            "--accept gravity_unti: is no kind of finding (did you mean \"gravity_unit\"?); "
            "docs/log_quality.md lists them");
  EXPECT_EQ(
      MessageOf({"leg_order"}, {WithRepair(FindingKind::kLegOrder, "mapping: legs in that order")}),
      "--accept leg_order: has no repair that can be made without a decision: mapping: legs "
      "in that order");
}

}  // namespace
}  // namespace scoria::app
