// SPDX-License-Identifier: BSD-3-Clause
// The commands that look at inputs, as a user calls them.
#include <array>
#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/files.h"
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
  EXPECT_NE(mule.find("   0.620   0.240   0.160   convex hull of 8 points, trunk.stl\n"),
            std::string::npos)
      << mule;
  test::TemporaryFolder folder;
  EXPECT_NE(Shell("info robots/none.yaml").find("none.yaml: cannot"), std::string::npos)
      << Shell("info robots/none.yaml");
}

TEST(Info, ListsTheDefaultsThatGoWithTheSize) {
  const std::string mule = Shell("info --defaults tests/data/robots/mule/mule.yaml");
  const double mass = 29.45 / 15.019, f_max_N = 250.0 * mass;
  EXPECT_NE(
      mule.find(fmt::format("{:56} {:>10} {:>10.4g}\n", "controller.mpc.f_max_N", 250, f_max_N)),
      std::string::npos)
      << mule;
  EXPECT_NE(mule.find("\noperator.look_ahead_m "), std::string::npos) << mule;
  const std::string go2 = Shell("info --defaults robots/go2/go2.yaml");
  EXPECT_EQ(go2.find("controller."), std::string::npos) << go2;
}

/// A robot YAML beside a changed copy of the Go2's URDF.
std::filesystem::path ChangedGo2(const test::TemporaryFolder& folder, const std::string& from,
                                 const std::string& to) {
  std::string urdf = test::Go2().urdf_text;
  urdf.replace(urdf.find(from), from.size(), to);
  core::WriteText(folder.path() / "dog.urdf", urdf);
  core::WriteText(
      folder.path() / "dog.yaml",
      fmt::format("base: {}\nurdf: {}\n", test::SourcePath("robots/go2/go2.yaml").string(),
                  (folder.path() / "dog.urdf").string()));
  return folder.path() / "dog.yaml";
}

TEST(Info, SaysThatARobotCannotCarryItself) {
  const test::TemporaryFolder folder;
  const auto heavy = ChangedGo2(folder, "mass value=\"6.921\"", "mass value=\"60\"");
  const std::string text = Shell("info " + heavy.string());
  EXPECT_NE(text.find(" of 23.7 Nm; it cannot carry itself: "), std::string::npos) << text;
  EXPECT_NE(text.find("force    ok      "), std::string::npos) << "its bound follows the mass";
  EXPECT_EQ(text.find("warning"), std::string::npos) << text;
}

TEST(Info, EndsWithAVerdict) {
  EXPECT_TRUE(Shell("info robots/go2/go2.yaml")
                  .ends_with("\nverdict: nothing in these files keeps it from walking\n"));
  const test::TemporaryFolder folder;
  const auto slow = ChangedGo2(folder, "velocity=\"15.7\"", "velocity=\"1.5\"");
  const std::string text = Shell("info " + slow.string());
  EXPECT_NE(text.find("speed    NOT MET to swing a leg at 0.5 m/s, FL_calf_joint turns at "),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("\nverdict: cannot walk as it is: speed\n")) << text;
}

TEST(Run, WarnsBeforeTheWalkUnlessQuiet) {
  const test::TemporaryFolder folder;
  (void)ChangedGo2(folder, "mass value=\"6.921\"", "mass value=\"60\"");
  std::string grid = "ncols 20\nnrows 20\ncellsize 0.5\n";
  for (int i = 0; i < 400; ++i) grid += i % 20 < 2 && i < 40 ? "9 " : "0 ";  // a corner of four
  core::WriteText(folder.path() / "g.asc", grid);
  const std::string run = fmt::format(
      "run scenarios/flat.yaml --set duration_s=0.2 --set controller.mpc.f_max_N=250 --set "
      "'robot={{base: {0}/dog.yaml}}' --set "
      "'terrain={{name: quarry, heightmap: {{file: {0}/g.asc}}}}' --out {0}/",
      folder.path().string());
  const std::string text = Shell(run + "told");
  EXPECT_NE(text.find("warning: go2: 68.1 kg are 334 N per foot on two feet, more than "
                      "controller.mpc.f_max_N 250; raise it\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(" of 23.7 Nm; it cannot carry itself: "), std::string::npos) << text;
  EXPECT_NE(text.find("warning: quarry: 3 of 400 nodes of the heightmap, steeper than "
                      "max_slope_rad 1.5, are lowered to it\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(Shell(run + "quiet --quiet"), "");
}

TEST(Schema, IsPrintedForEveryKind) {
  for (const char* kind : {"", "robot", "terrain", "campaign", "payload", "controller", "operator"})
    EXPECT_TRUE(nlohmann::json::parse(Shell(fmt::format("schema {}", kind))).is_object()) << kind;
  EXPECT_NE(Shell("schema robots").find("robot"), std::string::npos);
}

TEST(WrongFile, IsNamedInOneShortLine) {
  const test::TemporaryFolder folder;
  std::string grid = "ncols 200\nnrows 200\ncellsize 0.5\n";
  for (int i = 0; i < 40000; ++i) grid += "1.25 ";
  const std::string file = (folder.path() / "dem.asc").string();
  core::WriteText(file, grid);
  const std::string use = " (a terrain names it: heightmap: {file: NAME.asc})\n";
  for (const char* command : {"terrain", "run", "campaign"})
    EXPECT_EQ(Shell(fmt::format("{} {}", command, file)),
              file + ": is an ESRI ASCII grid, not a YAML file" + use)
        << command;
  EXPECT_EQ(Shell("info " + file),
            file + ": is an ESRI ASCII grid, not a log that scoria reads" + use);
  EXPECT_EQ(Shell("info robots/go2/go2.urdf"),
            "robots/go2/go2.urdf: is a URDF, not a YAML file (a robot's YAML names it: urdf: "
            "NAME.urdf)\n");
  EXPECT_EQ(Shell("run docs/images/vulcano.png"),
            "docs/images/vulcano.png: is a PNG image, not a YAML file (a terrain names it: "
            "heightmap: {file: NAME.png})\n");
  EXPECT_EQ(Shell("run campaigns/demo.yaml"),
            "campaigns/demo.yaml: is a campaign, not a scenario (for scoria campaign)\n");
  EXPECT_LT(Shell("run README.md").size(), 200u);
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
