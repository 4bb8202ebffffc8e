// SPDX-License-Identifier: BSD-3-Clause
// Input: IDL, one file or a ros2idl schema.
#include <string>

#include "logs/ros/idl_parser.h"
#include "tests/fuzz/fuzz.h"
#include "tests/logs/ros/types.h"

namespace scoria::test {

void FuzzIdl(std::span<const std::uint8_t> input) {
  try {
    const auto messages = logs::ParseIdl(std::string(input.begin(), input.end()), "idl");
    if (!messages.empty()) static_cast<void>(logs::ListLeaves(TypeOf(messages)));
  } catch (const logs::DefinitionError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzIdl)
