// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/log_origin.h"

#include <fstream>

#include <gtest/gtest.h>

#include "app/rerun/replay.h"
#include "app/rerun/verify.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "core/robot_files/mesh_records.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// The mule, whose trunk is a mesh, on a heightmap; robot and ground are files of the folder.
class StandAloneLog : public testing::Test {
 protected:
  StandAloneLog() {
    fs::copy(test::SourcePath("tests/data/robots/mule"), robot_, fs::copy_options::recursive);
    WriteGround(0.02);
  }

  void WriteGround(double step_m) const {
    std::ofstream out(ground_);
    out << "ncols 32\nnrows 32\nxllcorner 0\nyllcorner 0\ncellsize 0.25\n";
    for (int row = 0; row < 32; ++row) {
      for (int column = 0; column < 32; ++column) out << (row + column) % 2 * step_m << " ";
      out << "\n";
    }
  }

  void Walk() const {
    const Scenario scenario = test::LoadScenario(
        "flat", {"robot={base: " + (robot_ / "mule.yaml").string() + "}",
                 "terrain={heightmap: {file: " + ground_.string() + "}}", "duration_s=1"});
    RunOptions options;
    options.folder = folder_.path() / "run";
    (void)RunToFolder(scenario, options);
  }

  /// Rewrites the log with other metadata, or without its attachments.
  void Rewrite(const std::function<void(logs::LogMetadata&)>& change, bool attachments) const {
    const fs::path old = log_.string() + ".old";
    fs::rename(log_, old);
    logs::McapWriter writer(log_);
    const std::unique_ptr<logs::LogSource> source = logs::OpenLog(old);
    logs::LogMetadata metadata = source->contents().metadata.at(kScenarioMetadata);
    change(metadata);
    writer.AddMetadata(kScenarioMetadata, metadata);
    const auto heightmap = source->ReadAttachment("heightmap.zst");
    if (attachments && heightmap) writer.AddAttachment(*heightmap);
    std::map<std::string, std::uint16_t> channels;
    source->ForEach({}, [&](const logs::LogMessage& m) {
      const std::string& topic = m.channel.topic;
      if (!channels.contains(topic))
        channels[topic] = writer.AddChannel(topic, m.channel.type_name, m.channel.schema->text);
      writer.Write(channels[topic], m.log_time_ns, m.data);
    });
  }

  std::string GroundError() const {
    try {
      (void)GroundOf(ReadLogOrigin(log_));
    } catch (const std::exception& e) {
      return e.what();
    }
    return "none";
  }

  test::TemporaryFolder folder_;
  fs::path robot_ = folder_.path() / "mule", ground_ = folder_.path() / "ground.asc",
           log_ = folder_.path() / "run" / "log.mcap";
};

TEST_F(StandAloneLog, NeedsNeitherMeshNorHeightmap) {
  Walk();
  const std::vector<double> heights = GroundOf(ReadLogOrigin(log_)).heights_m();
  fs::remove_all(robot_);
  fs::remove(ground_);
  EXPECT_TRUE(VerifyLog(log_).identical) << VerifyLog(log_).difference;
  EXPECT_TRUE(ReplayLog(log_, {}).identical);
  EXPECT_EQ(GroundOf(ReadLogOrigin(log_)).heights_m(), heights);

  const fs::path video = folder_.path() / "v.mp4";
  const test::ProgramEnd end = test::RunScoria(
      {"render", log_.string(), "--to", "0.2", "--size", "64x64", "--out", video.string()});
  EXPECT_EQ(end.code, 0) << end.output;
  EXPECT_NE(end.output.find("trunk.stl is gone; its box is drawn\n"), std::string::npos)
      << end.output;
  EXPECT_TRUE(fs::exists(video));
}

TEST_F(StandAloneLog, ChangedFilesAreNotTaken) {
  Walk();
  const std::vector<double> heights = GroundOf(ReadLogOrigin(log_)).heights_m();
  WriteGround(0.3);
  EXPECT_EQ(GroundOf(ReadLogOrigin(log_)).heights_m(), heights);
  core::RobotDescription robot = RobotOf(ReadLogOrigin(log_));
  EXPECT_TRUE(core::DrawLostMeshesAsBoxes(robot).empty());
  const fs::path mesh = *core::MeshFiles(robot).begin();
  std::ofstream(mesh, std::ios::app) << " ";
  robot = RobotOf(ReadLogOrigin(log_));
  EXPECT_EQ(core::DrawLostMeshesAsBoxes(robot),
            std::vector<std::string>{"mesh " + mesh.string() +
                                     " has changed since the walk; its box is drawn"});
}

TEST_F(StandAloneLog, BoxOfALostMeshIsTheMeshsOwn) {
  Walk();
  const core::RobotDescription whole = RobotOf(ReadLogOrigin(log_));
  fs::remove_all(robot_);
  core::RobotDescription boxes = RobotOf(ReadLogOrigin(log_));
  ASSERT_EQ(boxes.collisions.size(), whole.collisions.size());
  for (std::size_t i = 0; i < boxes.collisions.size(); ++i) {
    EXPECT_EQ(boxes.collisions[i].size_m, whole.collisions[i].size_m);
    EXPECT_EQ(boxes.collisions[i].p_LG, whole.collisions[i].p_LG);
  }
  ASSERT_FALSE(core::DrawLostMeshesAsBoxes(boxes).empty());
  for (const core::Shape& shape : boxes.visuals) EXPECT_NE(shape.kind, core::Shape::Kind::kMesh);
}

TEST_F(StandAloneLog, HashAloneRefusesAnotherGround) {
  Walk();
  Rewrite([](logs::LogMetadata&) {}, false);
  EXPECT_EQ(GroundError(), "none") << "the file is there as it was";
  WriteGround(0.3);
  EXPECT_EQ(GroundError(),
            log_.string() + ": its ground " + ground_.string() +
                " has changed since the walk, and the log holds only the hash of it");
  fs::remove(ground_);
  EXPECT_EQ(GroundError(), log_.string() + ": its ground " + ground_.string() +
                               " cannot be read, and the log holds only the hash of it");
}

TEST_F(StandAloneLog, OlderLogsStillRead) {
  Walk();
  Rewrite(
      [](logs::LogMetadata& metadata) {
        for (const char* key : {"meshes", "heightmap_hash", "checksum"}) metadata.erase(key);
      },
      false);
  EXPECT_TRUE(VerifyLog(log_).identical) << VerifyLog(log_).difference;
  EXPECT_TRUE(ReplayLog(log_, {}).identical);
}

TEST_F(StandAloneLog, DamagedRecordIsRefused) {
  Walk();
  Rewrite([](logs::LogMetadata& metadata) { metadata["scenario"] += "\nduration_s: 1e6\n"; }, true);
  EXPECT_EQ(GroundError(), log_.string() + ": the record of its scenario is damaged");
}

TEST_F(StandAloneLog, CutBeforeItsScenarioIsSaid) {
  Walk();
  fs::resize_file(log_, 2000);
  EXPECT_EQ(
      GroundError(),
      log_.string() +
          ": is cut off or damaged before its scenario; nothing of it can be re-run or drawn");
}

TEST(PackHeightmap, LeavesOutWhatIsTooLarge) {
  const test::TemporaryFolder folder;
  Scenario scenario = test::LoadScenario("flat");
  EXPECT_FALSE(PackHeightmap(scenario).has_value()) << "there is none";
  scenario.terrain.heightmap.file = folder.path() / "large.png";
  std::string noise(kLargestPackedHeightmap + (1 << 20), '\0');
  core::Rng rng(1, 0, core::Stream::kSensor);
  for (char& c : noise) c = static_cast<char>(rng.NextU32());
  core::WriteText(scenario.terrain.heightmap.file, noise);
  EXPECT_FALSE(PackHeightmap(scenario).has_value());
  core::WriteText(scenario.terrain.heightmap.file, std::string_view(noise).substr(0, 100000));
  EXPECT_TRUE(PackHeightmap(scenario).has_value());
}

}  // namespace
}  // namespace scoria::app
