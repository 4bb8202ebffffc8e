// SPDX-License-Identifier: BSD-3-Clause
// Input: a file of a rosbag2 bag of the sqlite3 storage, or a zstd frame of one.
#include <stdexcept>

#include "logs/format/open_log.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/log_target.h"

namespace scoria::test {

void FuzzDb3(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  std::unique_ptr<logs::LogSource> log;
  try {
    log = logs::OpenLog(file.path());
  } catch (const std::runtime_error&) {  // no log, in words
    return;
  }
  ReadWhole(*log);
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzDb3)
