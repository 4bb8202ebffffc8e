// SPDX-License-Identifier: BSD-3-Clause
// `scoria info` of logs, as a user calls it.
#include "app/inspect/log_info.h"

#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/messages/scoria.h"
#include "tests/support/mcap_file.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
namespace msg = logs::msg;

/// Three commands, which have no header.
void WriteCommands(const fs::path& path) {
  logs::McapWriter writer(path);
  const std::uint16_t channel =
      writer.AddChannel("/quad_control_target", msg::QuadControlTarget::kTypeName,
                        logs::SchemaWriter::SchemaOf<msg::QuadControlTarget>());
  for (int i = 0; i < 3; ++i) {
    msg::QuadControlTarget message;
    logs::Bytes bytes;
    logs::EncodeCdr(message, bytes);
    writer.Write(channel, 1'700'000'000'000'000'000 + i * 20'000'000, bytes);
  }
  writer.AddMetadata("weather", {{"wind", "strong"}});
  writer.AddAttachment({"notes.txt", "text/plain", logs::Bytes(3, std::byte{'a'})});
}

TEST(LogInfo, ShowsLogTopicsAndClocks) {
  const test::TemporaryFolder folder;
  const fs::path log = folder.path() / "log.mcap";
  WriteCommands(log);
  test::ProgramEnd end = test::RunScoria({"info", log.string()});
  EXPECT_EQ(end.code, 0);
  const std::size_t mapping = end.output.find("\n" + log.string() + ": none of the mappings ");
  ASSERT_NE(mapping, std::string::npos) << end.output;
  EXPECT_TRUE(end.output.ends_with(
      "; write one (docs/mappings.md) or draft one: scoria info LOG --draft-mapping FILE\n"))
      << end.output;
  end.output.erase(mapping);
  EXPECT_EQ(
      end.output,
      fmt::format(
          "{}: an MCAP log, 0.001 MB\n"
          "  recorded     2023-11-14 22:13:20.000 UTC to 2023-11-14 22:13:20.040 UTC, "
          "0.040 s\n"
          "  messages     3 on 1 topics, 1 of them decoded\n"
          "  metadata     weather\n"
          "  attachments  notes.txt\n"
          "\n"
          "                                                                  receive             "
          "            header                             receive\n"
          "topic                 type                              messages       Hz  "
          "span s  regular  back      Hz  span s  regular  back  - header ms  definition\n"
          "/quad_control_target  interfaces/msg/QuadControlTarget         3     50.0   "
          "0.040    100 %     0       -       -        -     -            -  the bag\n",
          log.string()));
}

TEST(LogInfo, TellsHowALogBecomesSignalsAndDraftsAMapping) {
  const test::TemporaryFolder folder;
  const std::string log = test::SourcePath("samples/go2_walk.mcap").string();
  const std::string shipped = test::RunScoria({"info", log}).output;
  EXPECT_NE(shipped.find("\nmapping dfki_quad: 900 rows, one for each message of /quad_state\n"),
            std::string::npos)
      << shipped;
  EXPECT_NE(shipped.find("  canonical signals: measured, command, joint_command, plan, reference, "
                         "estimate, contacts, model, solve_times\n"),
            std::string::npos)
      << shipped;
  const std::string draft = (folder.path() / "draft.yaml").string();
  EXPECT_EQ(test::RunScoria({"info", log, "--draft-mapping", draft}).code, 0);
  const std::string drafted = test::RunScoria({"info", log, "--mapping", draft}).output;
  EXPECT_NE(drafted.find("\nmapping draft: 900 rows, "), std::string::npos) << drafted;
  EXPECT_EQ(test::RunScoria({"info", log, "--draft-mapping", draft}).output,
            draft + ": exists; name a file that does not\n");
  EXPECT_EQ(test::RunScoria({"info", log, "--mapping", "dfki_squad"}).code, 2);
}

TEST(LogInfo, JsonHoldsTheSame) {
  const test::TemporaryFolder folder;
  const fs::path log = folder.path() / "log.mcap";
  WriteCommands(log);
  const auto json = nlohmann::json::parse(test::RunScoria({"info", log.string(), "--json"}).output);
  EXPECT_EQ(json["format"], "an MCAP log");
  EXPECT_EQ(json["messages"], 3);
  EXPECT_EQ(json["metadata"]["weather"]["wind"], "strong");
  EXPECT_EQ(json["attachments"], nlohmann::json{"notes.txt"});
  EXPECT_EQ(json["problems"], nlohmann::json::array());
  const nlohmann::json& topic = json["topics"].at(0);
  EXPECT_EQ(topic["topic"], "/quad_control_target");
  EXPECT_EQ(topic["receive"]["rate_Hz"], 50.0);
  EXPECT_EQ(topic["receive"]["span"]["first_ns"], 1'700'000'000'000'000'000);
  EXPECT_TRUE(topic["header"].is_null());
  EXPECT_EQ(topic["definition"], "the bag");
}

// A log without definitions, as sqlite bags are, of a type of the user's own.
TEST(LogInfo, SaysWhyATopicIsNotDecodedAndTakesTheUsersDefinition) {
  const test::TemporaryFolder folder;
  const fs::path log = folder.path() / "log.mcap";
  core::WriteText(
      log, test::McapFile(test::McapSchema(1, "our_msgs/msg/Wind", "", "") +
                          test::McapChannel(1, 1, "/wind", "cdr") +
                          test::McapMessage(1, 5, test::Number(0x100, 4) + test::Number(7, 4))));
  const std::string without = test::RunScoria({"info", log.string()}).output;
  EXPECT_NE(without.find("\n/wind: not decoded: no definition of our_msgs/msg/Wind in the bag, "
                         "below --msg-path or built in\n"),
            std::string::npos)
      << without;
  core::CreateFolders(folder.path() / "our_msgs/msg");
  core::WriteText(folder.path() / "our_msgs/msg/Wind.msg", "int32 speed\n");
  const std::string with =
      test::RunScoria({"info", log.string(), "--msg-path", folder.path().string()}).output;
  EXPECT_NE(with.find(fmt::format("  --msg-path {}\n", folder.path().string())), std::string::npos)
      << with;
  const test::ProgramEnd none =
      test::RunScoria({"info", log.string(), "--msg-path", (folder.path() / "x").string()});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.output.find("/x"), std::string::npos) << none.output;
}

TEST(LogInfo, IsChosenByContent) {
  const test::TemporaryFolder folder;
  const fs::path log = folder.path() / "robot.yaml";
  WriteCommands(log);
  EXPECT_NE(test::RunScoria({"info", log.string()}).output.find("an MCAP log"), std::string::npos);
  EXPECT_TRUE(IsTakenForLog(folder.path()));
  const auto is_log = [&](const std::string& text) {
    core::WriteText(folder.path() / "file", text);
    return IsTakenForLog(folder.path() / "file");
  };
  EXPECT_FALSE(is_log("# a dog\n\nname: dog\nurdf: dog.urdf\n"));
  EXPECT_FALSE(is_log("base: ../go2/go2.yaml\n"));
  EXPECT_FALSE(is_log("<?xml version=\"1.0\"?>\n<robot name=\"dog\"></robot>\n"));
  EXPECT_TRUE(is_log("rosbag2_bagfile_information:\n  version: 5\n"));
  EXPECT_TRUE(is_log("time,q0,q1\n0.0,1,2\n"));
  EXPECT_TRUE(is_log("#ROSBAG V2.0\n"));
  EXPECT_TRUE(is_log(""));
}

TEST(LogInfo, AnswersMistakesInWords) {
  const test::TemporaryFolder folder;
  const auto run = [&](const std::vector<std::string>& arguments) {
    return test::RunScoria(arguments, {.folder = folder.path()});
  };
  const test::ProgramEnd missing = run({"info", "none.mcap"});
  EXPECT_EQ(missing.code, 4);
  EXPECT_EQ(missing.output, "none.mcap: cannot read the file: no such file or directory\n");
  core::WriteText(folder.path() / "bag.bag", "#ROSBAG V2.0\n");
  const test::ProgramEnd bag = run({"info", "bag.bag"});
  EXPECT_EQ(bag.code, 2);
  EXPECT_NE(bag.output.find("bag.bag: is a ROS 1 bag, not a log"), std::string::npos) << bag.output;
  core::WriteText(folder.path() / "dog.yaml", "name: dog\n");
  EXPECT_EQ(
      run({"info", "dog.yaml", "--json"}).output,
      "dog.yaml: is no log; --json, --msg-path, --mapping and --draft-mapping are for logs\n");
}

// --- Damaged logs of others ---

class BrokenLogs : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SCORIA_REFERENCE_DATA");
    if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
    folder_ = fs::path(data) / "mcap/broken";
  }
  [[nodiscard]] test::ProgramEnd Info(const char* name) const {
    return test::RunScoria({"info", name}, {.folder = folder_});
  }
  fs::path folder_;
};

TEST_F(BrokenLogs, AreShownWithWhatTheirDamageCosts) {
  const test::ProgramEnd flipped = Info("flipped_byte_in_chunk.mcap");
  EXPECT_EQ(flipped.code, 0);
  EXPECT_NE(flipped.output.find(
                "/joint_states: 353 of the 400 messages that the log announces are there\n"),
            std::string::npos)
      << flipped.output;
  EXPECT_NE(flipped.output.find("flipped_byte_in_chunk.mcap: at byte 16728: chunk has a wrong "
                                "checksum; 149 messages are lost, 0.200 s to 0.430 s after the "
                                "log's first (a part is missing)\n"),
            std::string::npos)
      << flipped.output;
  EXPECT_NE(Info("truncated_60pct.mcap")
                .output.find("truncated_60pct.mcap: cut off at byte 86787; everything before it "
                             "was read (its end is missing)\n"),
            std::string::npos);
  EXPECT_NE(Info("bad_start_magic.mcap")
                .output.find("bad_start_magic.mcap: its first bytes are damaged (nothing is "
                             "missing for it)\n"),
            std::string::npos);
  const test::ProgramEnd empty = Info("empty.mcap");
  EXPECT_EQ(empty.code, 2);
  EXPECT_EQ(empty.output, "empty.mcap: is empty\n");
}

}  // namespace
}  // namespace scoria::app
