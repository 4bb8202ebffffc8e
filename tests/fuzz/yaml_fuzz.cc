// SPDX-License-Identifier: BSD-3-Clause
// Input: the YAML of a robot, or the sections of a scenario that are not of app/ alone.
#include <optional>
#include <string>
#include <vector>

#include "controller/controller.h"
#include "core/config/archive.h"
#include "core/demand.h"
#include "core/robot/description.h"
#include "sim/payload.h"
#include "sim/plant/plant.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sensor_params.h"
#include "sim/sliding_payload.h"
#include "terrains/params.h"
#include "tests/fuzz/fuzz.h"

namespace scoria::test {
namespace {

struct Sections {
  core::RobotConfig robot;
  terrains::TerrainParams terrain;
  sim::PhysicsParams physics;
  sim::SensorParams sensors;
  std::vector<sim::SensorFault> sensor_faults;
  std::vector<sim::PayloadEvent> payloads;
  std::optional<sim::SlidingPayloadParams> sliding_payload;
  controller::ControllerParams controller;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("robot", robot);
    a.Field("terrain", terrain);
    a.Field("physics", physics);
    a.Field("sensors", sensors);
    a.Field("sensor_faults", sensor_faults);
    a.Field("payloads", payloads);
    a.Field("sliding_payload", sliding_payload);
    a.Field("controller", controller);
  }
};

/// What was read is written as it would be read.
template <class T>
void ReadAndWrite(const core::ConfigNode& node) {
  std::string written;
  try {
    written = core::EmitYaml(core::WriteConfig(core::ReadConfig<T>(node)));
  } catch (const core::ConfigError&) {
    return;
  }
  const T again = core::ReadConfig<T>(core::ParseConfig(written, "written"));
  const std::string twice = core::EmitYaml(core::WriteConfig(again));
  SCORIA_DEMAND(twice == written, "\n{}\n{}", written, twice);
}

}  // namespace

void FuzzYaml(std::span<const std::uint8_t> input) {
  const std::string text(input.begin(), input.end());
  if (text.find("base") != std::string::npos) return;  // names files of this machine
  core::ConfigNode node;
  try {
    node = core::ParseConfig(text, "input");
  } catch (const core::ConfigError&) {
    return;
  }
  ReadAndWrite<Sections>(node);
  ReadAndWrite<core::RobotConfig>(node);
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzYaml)
