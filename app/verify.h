// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/scenario.h"

namespace scoria::app {

/// A log's own account of how it was made.
struct LogOrigin {
  Scenario scenario;
  std::string urdf_text;
};

/// @param overrides of scenario keys, as "controller.gait.type=sgs".
/// Errors: std::runtime_error if the file is no log of scoria; core::ConfigError for an override.
[[nodiscard]] LogOrigin ReadLogOrigin(const std::filesystem::path& log,
                                      const std::vector<std::string>& overrides = {});

struct VerifyResult {
  bool identical = false;
  std::uint64_t messages = 0;  // compared
  std::string difference;      // first one: step, time, topic, field, both values
  std::string file_problem;    // a truncated log, in words
};

/// Re-runs the episode of a log and compares every reproducible message bit for bit.
[[nodiscard]] VerifyResult VerifyLog(const std::filesystem::path& log);

}  // namespace scoria::app
