// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/robot/description.h"
#include "core/robot/state.h"

namespace scoria::test {

/// A millisecond of a Go1 that trots in another team's simulator: 14.10 kg, where its URDF says
/// 13.10.
struct LogTick {
  RobotState state;
  SensorFrame z;
  LegArray<Vec3> f_F_W = ZeroPerLeg();
  LegArray<bool> contact;
};

inline constexpr double kGo1FootRadius_m = 0.02;
inline constexpr std::size_t kGo1SettleTicks = 20;  // of the log's start: left out of scores

/// Where the log lies; nothing if SCORIA_REFERENCE_DATA is not set.
std::optional<std::filesystem::path> Go1Folder();

core::RobotDescription LoadGo1(const std::filesystem::path& folder);

std::vector<LogTick> ReadGo1Log(const std::filesystem::path& folder,
                                const core::RobotDescription& robot);

}  // namespace scoria::test
