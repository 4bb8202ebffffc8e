// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/labels.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria::app {
namespace {

using analysis::FallVerdict;

std::vector<LabelEntry> Read(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return ReadLabels(file);
}

TEST(Labels, AreReadWithOrWithoutATitleLine) {
  const test::TemporaryFolder folder;
  const auto entries = Read(
      folder.path() / "labels.csv",
      "time,verdict,log\n12.5, fall\n13, not a fall, walk_2\r\n\n1700000004.25,operator stop\n");
  ASSERT_EQ(entries.size(), 3U);
  const auto first = LabelsOf(entries, "walk_1", 1.7e9);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_DOUBLE_EQ(first[0].time_s, 4.25);
  EXPECT_EQ(first[0].verdict, FallVerdict::kOperatorStop);
  EXPECT_DOUBLE_EQ(first[1].time_s, 12.5);
  EXPECT_EQ(LabelsOf(entries, "walk_2", 1.7e9).size(), 3U);
}

TEST(Labels, NameTheLineThatIsWrong) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "labels.csv";
  const auto message_of = [&](const std::string& text) {
    try {
      (void)Read(file, text);
    } catch (const std::exception& e) {
      return std::string(e.what()).substr(file.string().size());
    }
    return std::string();
  };
  EXPECT_EQ(message_of("1,fall\nsoon,fall\n"), ":2: time: \"soon\" is no number of seconds");
  EXPECT_EQ(message_of("1,falls\n"),
            ":1: verdict: unknown \"falls\"; choices: fall, not a fall, operator stop (did you "
            "mean \"fall\"?)");
}

}  // namespace
}  // namespace scoria::app
