// SPDX-License-Identifier: BSD-3-Clause
// Runs every fuzz target over its corpus; what fuzzing finds is added there.
#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/fuzz/fuzz.h"

namespace scoria::test {
namespace {

namespace fs = std::filesystem;

using Target = void (*)(std::span<const std::uint8_t>);

TEST(FuzzCorpus, EveryTargetTakesItsCorpus) {
  const std::map<std::string, Target> targets = {
      {"cdr", FuzzCdr},   {"msg", FuzzMsg},   {"idl", FuzzIdl},
      {"mcap", FuzzMcap}, {"db3", FuzzDb3},   {"bag_metadata", FuzzBagMetadata},
      {"urdf", FuzzUrdf}, {"yaml", FuzzYaml}, {"mapping", FuzzMapping}};
  const fs::path corpus = fs::path(SCORIA_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const auto& entry : fs::directory_iterator(corpus)) {
    EXPECT_TRUE(targets.contains(entry.path().filename())) << entry.path() << " has no target";
  }
  for (const auto& [name, target] : targets) {
    int inputs = 0;
    for (const auto& entry : fs::directory_iterator(corpus / name)) {
      const std::string text = core::ReadText(entry.path());
      SCOPED_TRACE(entry.path());
      target(
          {static_cast<const std::uint8_t*>(static_cast<const void*>(text.data())), text.size()});
      ++inputs;
    }
    EXPECT_GT(inputs, 0) << name;
  }
}

}  // namespace
}  // namespace scoria::test
