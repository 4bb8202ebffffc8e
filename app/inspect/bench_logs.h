// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scoria::app {

/// How fast one log is read, from opening it to its last message, in the order of time, on one
/// core and from memory: the fastest of some passes.
struct LogBenchmark {
  std::string name;
  std::uint64_t file_bytes = 0, message_bytes = 0, messages = 0;
  double open_s = 0.0, read_s = 0.0;
  [[nodiscard]] double MBPerS() const;  // 10⁶ bytes of messages a second
};

/// Errors: those of OpenLog.
[[nodiscard]] LogBenchmark BenchmarkLog(const std::string& name, const std::filesystem::path& log);

/// Writes logs as a robot of 1 kHz has them (some 0.5 kB a message, half of it noise) into a
/// temporary folder and reads them: MCAP without compression, by zstd and lz4, and an sqlite3 bag.
/// @param megabytes  of messages in each.
[[nodiscard]] std::vector<LogBenchmark> BenchmarkLogFormats(int megabytes);

}  // namespace scoria::app
