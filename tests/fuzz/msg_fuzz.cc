// SPDX-License-Identifier: BSD-3-Clause
// Input: a ros2msg schema of pkg/msg/Type.
#include <string>

#include "logs/ros/field_path.h"
#include "tests/fuzz/fuzz.h"
#include "tests/logs/ros/types.h"

namespace scoria::test {

void FuzzMsg(std::span<const std::uint8_t> input) {
  const std::string schema(input.begin(), input.end());
  try {
    const logs::MessageType type = TypeOf(schema);
    static_cast<void>(logs::ListLeaves(type));
    static_cast<void>(logs::ResolveField(type, schema.substr(0, schema.find('\n'))));
  } catch (const logs::DefinitionError&) {
  } catch (const logs::FieldPathError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzMsg)
