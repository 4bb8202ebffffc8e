// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace scoria::app {

struct VerifyResult {
  bool identical = false;
  std::uint64_t messages = 0;  // compared
  bool complete = true;        // false for a log that is cut off or of an interrupted run
  double until_s = 0.0;        // how far it was compared
  std::string difference;      // first one: step, time, topic, field, both values
  std::string file_problem;    // a truncated log, in words
  std::string missing;         // topics that the log lacks by its scenario, in words
};

/// Re-runs the episode of a log and compares every reproducible message bit for bit, as far as the
/// log goes. Errors: as ReadLogOrigin and GroundOf.
[[nodiscard]] VerifyResult VerifyLog(const std::filesystem::path& log);

}  // namespace scoria::app
