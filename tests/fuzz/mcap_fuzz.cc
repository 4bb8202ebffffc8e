// SPDX-License-Identifier: BSD-3-Clause
// Input: an MCAP file.
#include <stdexcept>

#include "logs/format/mcap_log.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/log_target.h"

namespace scoria::test {

void FuzzMcap(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  ReadWhole(*logs::OpenMcap(logs::LogFile(file.path())));
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzMcap)
