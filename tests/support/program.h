// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/types.h>

namespace scoria::test {

/// How a process ended.
struct ProgramEnd {
  int code = 0;        // exit code, or minus the signal that killed it
  std::string output;  // of both streams
  long peak_kB = 0;    // resident memory
  bool hung = false;   // it was killed for its time
};

struct ProgramOptions {
  std::filesystem::path folder;  // to run in; empty: this one
  rlim_t largest_file = 0;       // RLIMIT_FSIZE; 0: no limit
  int patience_s = 120;          // then it hangs
};

/// Runs `scoria` with these arguments to its end.
[[nodiscard]] ProgramEnd RunScoria(const std::vector<std::string>& arguments,
                                   const ProgramOptions& options = {});

/// Starts `scoria` in the background, without output. Whoever starts it waits for it.
[[nodiscard]] pid_t StartScoria(const std::vector<std::string>& arguments);

/// Waits for a process of StartScoria. @returns as ProgramEnd::code.
int WaitFor(pid_t process);

/// The children of a process; none if it is gone.
[[nodiscard]] std::vector<pid_t> ChildrenOf(pid_t process);

}  // namespace scoria::test
