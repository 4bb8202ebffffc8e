// SPDX-License-Identifier: BSD-3-Clause
// Input: a metadata.yaml of rosbag2.
#include <stdexcept>

#include "logs/format/bag_metadata.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/log_target.h"

namespace scoria::test {

void FuzzBagMetadata(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  try {
    const logs::BagMetadata metadata = logs::ReadBagMetadata(file.path());
    static_cast<void>(logs::CompareMetadata(metadata, {}));
  } catch (const std::runtime_error&) {  // what is wrong with it, in words
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzBagMetadata)
