// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/check/find_tests.h"
#include "app/check/judge.h"

namespace scoria::app {

/// Passed; failed: a bound is not met; error: an episode crashed or was no walk.
enum class CheckStatus { kPassed, kFailed, kError };
constexpr std::array<std::pair<CheckStatus, std::string_view>, 3> EnumNames(CheckStatus) {
  return {{{CheckStatus::kPassed, "passed"},
           {CheckStatus::kFailed, "failed"},
           {CheckStatus::kError, "error"}}};
}

struct CheckOutcome {
  const CheckTest* test = nullptr;
  CheckStatus status = CheckStatus::kPassed;
  double wall_s = 0.0;  // of its episodes' processes, added up
  std::vector<Finding> findings;
  std::vector<std::string> errors;               // why episodes were no walks
  std::vector<std::filesystem::path> artifacts;  // of a failure
  std::string artifact_problem;                  // why there are none, in words
};

struct CheckOptions {
  std::filesystem::path folder;  // a folder for each test
  int workers = 2;
  std::string program;  // the scoria executable
  bool artifacts = true;
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const CheckOutcome& outcome)> on_outcome;  // as soon as a test is judged
  std::function<void(int episodes_done, int of)> on_progress;   // many times a second
};

struct CheckRun {
  std::vector<CheckOutcome> outcomes;  // of tests that came to their end, in the order of those
  bool interrupted = false;
  std::string disk_problem;
};

/// Walks the tests' episodes in worker processes and judges each test when its last one has ended.
/// Then what failed is walked again with its log: the same bits, so that log, clip and figure show
/// the failure.
/// @param tests  borrowed by what is returned.
/// Errors: core::FolderInUse, core::FileError.
[[nodiscard]] CheckRun RunChecks(const std::vector<CheckTest>& tests, const CheckOptions& options);

}  // namespace scoria::app
