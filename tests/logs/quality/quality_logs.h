// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/description.h"
#include "logs/quality/finding.h"
#include "logs/row.h"

namespace scoria::test {

/// A log that has no fault, and the robot of it.
struct CleanLog {
  std::string name;
  std::vector<logs::Row> rows;
  std::shared_ptr<const core::RobotDescription> robot;
};

/// A few seconds of the Go2 as a field log has them: without truth, the estimate for attitude.
/// @param scenario  of the repository, as "rough"; "flat" walks and turns as the seed says.
[[nodiscard]] CleanLog WalkOfGo2(const std::string& scenario, int seed);

/// data/logs/go1_sim_trot_mpi and data/logs/minicheetah_raisim by their mappings.
/// @pre SCORIA_REFERENCE_DATA is set.
[[nodiscard]] CleanLog Go1Log();
[[nodiscard]] CleanLog MiniCheetahLog();

/// A file of data/logs; nothing if SCORIA_REFERENCE_DATA is not set.
[[nodiscard]] std::optional<std::filesystem::path> RecordedLog(const std::string& name);

/// Rows of recorded files by the shipped mapping that fits, or by the text of one.
[[nodiscard]] std::vector<logs::Row> ReadRecordedLog(const std::vector<std::string>& names,
                                                     const std::string& mapping_text = "");

/// Six seconds of a log, or all if it is shorter, that begin later with each of ten places.
[[nodiscard]] std::vector<logs::Row> Window(const std::vector<logs::Row>& rows, int place);

[[nodiscard]] std::vector<logs::Finding> Judge(const std::vector<logs::Row>& rows,
                                               const core::RobotDescription* robot);

}  // namespace scoria::test
