// SPDX-License-Identifier: BSD-3-Clause
// The commands that look at inputs, as a user calls them.
#include <array>
#include <cstdio>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/robots.h"

namespace scoria::app {
namespace {

/// What a command prints on both streams.
std::string Shell(const std::string& arguments) {
  const std::string command = fmt::format("cd '{}' && '{}' {} 2>&1", test::SourcePath("").string(),
                                          SCORIA_PROGRAM, arguments);
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  pclose(pipe);
  return text;
}

TEST(Info, PrintsTheRobotAndItsWarnings) {
  const std::string go2 = Shell("info robots/go2/go2.yaml");
  EXPECT_NE(go2.find("go2: 15.019 kg, with foot sensors"), std::string::npos) << go2;
  EXPECT_EQ(go2.find("warning"), std::string::npos) << go2;
  const std::string mule = Shell("info tests/data/robots/mule/mule.yaml");
  EXPECT_NE(mule.find("warning: body: collides as the box around trunk.stl"), std::string::npos)
      << mule;
  test::TemporaryFolder folder;
  EXPECT_NE(Shell("info robots/none.yaml").find("none.yaml: cannot"), std::string::npos)
      << Shell("info robots/none.yaml");
}

TEST(Terrain, DrawsAndMeasuresAPreset) {
  test::TemporaryFolder folder;
  const std::string out = folder.path().string();
  const std::string text =
      Shell(fmt::format("terrain mars_vl1 --set size_m=12.8 --seed 2 --out {}", out));
  EXPECT_NE(text.find("duricrust"), std::string::npos) << text;
  for (const char* name : {"relief.png", "deviogram.svg", "terrain.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  const auto json = nlohmann::json::parse(
      Shell("terrain mars_vl1 --set size_m=12.8 --seed 2 --json --no-pictures"));
  EXPECT_GT(json.at("nu_1m_m").get<double>(), 0.04);
  EXPECT_TRUE(
      nlohmann::json::parse(Shell("terrain flat --json --no-pictures")).at("hurst").is_null());
}

TEST(Terrain, UnknownPresetNamesTheChoices) {
  EXPECT_EQ(
      Shell("terrain lunar_mar"),
      "lunar_mar: terrain: is neither a file nor a preset; choices: aa_flow, ash_field, flat, "
      "lunar_mare, mars_vl1, pahoehoe, rl_rough, self_affine, vulcano_crater_rim (did you "
      "mean \"lunar_mare\"?)\n");
}

}  // namespace
}  // namespace scoria::app
