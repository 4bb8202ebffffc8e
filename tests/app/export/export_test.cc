// SPDX-License-Identifier: BSD-3-Clause
// `scoria export`: what it writes reads back, and what it refuses.
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/export/export_csv.h"
#include "app/export/export_mcap.h"
#include "app/export/export_signals.h"
#include "app/rerun/verify.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "core/rng.h"
#include "logs/channel_types.h"
#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/messages/scoria.h"
#include "logs/read_rows.h"
#include "logs/survey.h"
#include "tests/support/mcap_file.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
namespace msg = logs::msg;
using Texts = std::vector<std::string>;

constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;
constexpr std::int64_t kStep_ns = 2'000'001;

/// Lines of a CSV file without quoted cells.
std::vector<Texts> ReadCsv(const fs::path& path) {
  std::vector<Texts> lines;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    Texts& cells = lines.emplace_back();
    std::istringstream rest(line + ",");
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  }
  return lines;
}

struct Copied {
  std::string topic;
  std::int64_t log_time_ns;
  std::optional<std::int64_t> publish_time_ns;
  std::optional<std::uint32_t> sequence;
  logs::Bytes data;
  bool operator==(const Copied&) const = default;
};

std::vector<Copied> MessagesOf(logs::LogSource& log) {
  std::vector<Copied> messages;
  log.ForEach({.order = logs::LogOrder::kStored}, [&](const logs::LogMessage& m) {
    messages.push_back({m.channel.topic,
                        m.log_time_ns,
                        m.publish_time_ns,
                        m.sequence,
                        {m.data.begin(), m.data.end()}});
  });
  return messages;
}

class Export : public testing::Test {
 protected:
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }
  [[nodiscard]] fs::path log() const { return folder() / "log.mcap"; }

  /// Runs the command there.
  [[nodiscard]] test::ProgramEnd Run(std::vector<std::string> arguments,
                                     rlim_t largest_file = 0) const {
    arguments.insert(arguments.begin(), "export");
    return test::RunScoria(arguments, {.folder = folder(), .largest_file = largest_file});
  }

  /// Joints and commands, every number at random.
  void WriteLog(int messages) {
    logs::McapWriter writer(log());
    const std::uint16_t joints = writer.AddChannel("/joint_states", msg::JointState::kTypeName,
                                                   logs::SchemaWriter::SchemaOf<msg::JointState>());
    const std::uint16_t target =
        writer.AddChannel("/quad_control_target", msg::QuadControlTarget::kTypeName,
                          logs::SchemaWriter::SchemaOf<msg::QuadControlTarget>());
    core::Rng rng(3, 0, core::Stream::kRocks);
    logs::Bytes bytes;
    for (int i = 0; i < messages; ++i) {
      const std::int64_t time_ns = kStart_ns + i * kStep_ns;
      msg::JointState joint;
      joint.header.frame_id = "base";
      joint.header.stamp = {1'699'999'999, static_cast<std::uint32_t>(i)};
      for (auto* values : {&joint.position, &joint.velocity, &joint.effort, &joint.acceleration})
        for (double& value : *values) value = rng.NextNormal();
      joints_.push_back(joint);
      logs::EncodeCdr(joint, bytes);
      writer.Write(joints, time_ns, bytes);
      msg::QuadControlTarget command;
      command.body_x_dot = rng.NextUniform();
      logs::EncodeCdr(command, bytes);
      writer.Write(target, time_ns, bytes);
    }
  }

  std::vector<msg::JointState> joints_;

 private:
  test::TemporaryFolder folder_;
};

// --- CSV ---

TEST_F(Export, CsvReadsBackToTheSameNumbers) {
  WriteLog(50);
  const test::ProgramEnd end = Run({"log.mcap", "-o", "csv"});
  EXPECT_EQ(end.code, 0);
  EXPECT_EQ(end.output, "csv/joint_states.csv: 50 rows\ncsv/quad_control_target.csv: 50 rows\n");
  const std::vector<Texts> lines = ReadCsv(folder() / "csv/joint_states.csv");
  ASSERT_EQ(lines.size(), 51u);
  const Texts& head = lines[0];
  ASSERT_EQ(head.size(), 2u + 3 + 48);
  EXPECT_EQ(Texts(head.begin(), head.begin() + 6),
            (Texts{"receive_time_s", "header_time_s", "header.stamp.sec", "header.stamp.nanosec",
                   "header.frame_id", "position[0]"}));
  EXPECT_EQ(head.back(), "acceleration[11]");
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Texts& line = lines[i + 1];
    EXPECT_EQ(line[0], fmt::format("1700000000.{:09}", static_cast<std::int64_t>(i) * kStep_ns));
    EXPECT_EQ(line[1], fmt::format("1699999999.{:09}", i));
    EXPECT_EQ(line[4], "base");
    std::size_t column = 5;
    for (const auto* values : {&joints_[i].position, &joints_[i].velocity, &joints_[i].effort,
                               &joints_[i].acceleration}) {
      for (const double value : *values)
        EXPECT_EQ(std::strtod(line.at(column++).c_str(), nullptr), value);
    }
  }
  EXPECT_EQ(ReadCsv(folder() / "csv/quad_control_target.csv")[0],
            (Texts{"receive_time_s", "body_x_dot", "body_y_dot", "world_z", "hybrid_theta_dot",
                   "pitch", "roll"}));
}

TEST_F(Export, TakesTopicsAndTimesThatAreWanted) {
  WriteLog(50);
  const test::ProgramEnd end = Run({"log.mcap", "-o", "target.csv", "--topics",
                                    "/quad_control_target", "--from", "0.01", "--to", "0.03"});
  EXPECT_EQ(end.output, "target.csv: 10 rows\n") << "5 to 14: steps are 2 ms and 1 ns";
  const std::vector<Texts> lines = ReadCsv(folder() / "target.csv");
  EXPECT_EQ(lines[1][0], "1700000000.010000005");
  EXPECT_EQ(lines.back()[0], "1700000000.028000014");
}

TEST_F(Export, TopicsOfOneNameAreFilesOfTheirOwn) {
  core::WriteText(
      log(), test::McapFile(test::McapSchema(1, "pkg/msg/A", "ros2msg", "int32 a\n") +
                            test::McapSchema(2, "pkg/msg/B", "ros2msg", "int32 b\n") +
                            test::McapChannel(1, 1, "/x/y", "cdr") +
                            test::McapChannel(2, 2, "/x/y", "cdr") +
                            test::McapMessage(1, 5, test::Number(0x100, 4) + test::Number(7, 4)) +
                            test::McapMessage(2, 6, test::Number(0x100, 4) + test::Number(8, 4))));
  EXPECT_EQ(Run({"log.mcap", "-o", "."}).output, "./x-y.csv: 1 rows\n./x-y-2.csv: 1 rows\n");
  EXPECT_EQ(core::ReadText(folder() / "x-y.csv"), "receive_time_s,a\n0.000000005,7\n");
  EXPECT_EQ(core::ReadText(folder() / "x-y-2.csv"), "receive_time_s,b\n0.000000006,8\n");
}

TEST_F(Export, WhatCannotBeDecodedIsNamed) {
  core::WriteText(
      log(),
      test::McapFile(test::McapSchema(1, "pkg/msg/A", "ros2msg", "int32 a\n") +
                     test::McapChannel(1, 1, "/a", "cdr") + test::McapChannel(2, 0, "/b", "json") +
                     test::McapMessage(1, 5, test::Number(0x100, 4) + test::Number(7, 4)) +
                     test::McapMessage(1, 6, test::Number(0x100, 4) + test::Number(7, 1)) +
                     test::McapMessage(2, 7, "{}")));
  const test::ProgramEnd end = Run({"log.mcap", "-o", "csv"});
  EXPECT_EQ(end.code, 0);
  EXPECT_NE(end.output.find("/b: left out: encoding \"json\" is not decoded (cdr is)\n"),
            std::string::npos)
      << end.output;
  EXPECT_NE(end.output.find("/a: 1 of 2 messages cannot be decoded and are left out: pkg/msg/A: "
                            "a: "),
            std::string::npos)
      << end.output;
  EXPECT_NE(end.output.find("csv/a.csv: 1 rows\n"), std::string::npos) << end.output;
  const test::ProgramEnd none = Run({"log.mcap", "-o", "none", "--topics", "/b"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.output,
            "log.mcap: no topic can be decoded; /b: left out: encoding \"json\" is not decoded "
            "(cdr is)\n");
}

// --- MCAP ---

/// Two channels on one topic, with all that a container can say of them.
std::string FieldLog() {
  const auto message = [](int channel, std::uint32_t sequence, std::uint64_t log_ns,
                          std::uint64_t publish_ns, const std::string& data) {
    return test::McapRecord(5, test::Number(channel, 2) + test::Number(sequence, 4) +
                                   test::Number(log_ns, 8) + test::Number(publish_ns, 8) + data);
  };
  const auto text = [](const std::string& s) { return test::Number(s.size(), 4) + s; };
  const std::string qos = text("offered_qos_profiles") + text("- depth: 7\n");
  return test::McapFile(test::McapSchema(1, "pkg/msg/A", "ros2idl", "struct A {};") +
                        test::McapRecord(4, test::Number(1, 2) + test::Number(1, 2) + text("/a") +
                                                text("cdr") + test::Number(qos.size(), 4) + qos) +
                        test::McapChannel(2, 0, "/a", "json") +
                        test::McapChannel(3, 0, "/silent", "json") +
                        message(1, 40, 2'000, 1'990, std::string("\0\1\0\0abc", 7)) +
                        message(2, 9, 1'000, 990, "{}") + message(1, 42, 3'000, 2'990, "") +
                        test::McapMetadata("weather") + test::McapAttachment("notes.txt", "windy"));
}

TEST_F(Export, McapIsTheSameBitForBit) {
  core::WriteText(log(), FieldLog());
  const test::ProgramEnd end = Run({"log.mcap", "-o", "new/copy.mcap"});
  EXPECT_EQ(end.output, "new/copy.mcap: 3 messages\n");
  const auto original = logs::OpenLog(log());
  const auto copy = logs::OpenLog(folder() / "new/copy.mcap");
  EXPECT_EQ(MessagesOf(*copy), MessagesOf(*original));
  const auto& theirs = original->contents();
  const auto& ours = copy->contents();
  ASSERT_EQ(ours.channels.size(), 3u) << "the silent one as well";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ours.channels[i].topic, theirs.channels[i].topic);
    EXPECT_EQ(ours.channels[i].type_name, theirs.channels[i].type_name);
    EXPECT_EQ(ours.channels[i].schema, theirs.channels[i].schema);
    EXPECT_EQ(ours.channels[i].message_encoding, theirs.channels[i].message_encoding);
    EXPECT_EQ(ours.channels[i].metadata, theirs.channels[i].metadata);
  }
  EXPECT_EQ(ours.span, theirs.span);
  EXPECT_EQ(ours.metadata, theirs.metadata);
  EXPECT_EQ(copy->ReadAttachment("notes.txt")->data, original->ReadAttachment("notes.txt")->data);
  EXPECT_TRUE(copy->problems().empty()) << logs::ProblemText(copy->problems());
}

TEST_F(Export, McapOfALogWithoutDefinitionsHasThem) {
  msg::JointState message;
  logs::Bytes bytes;
  logs::EncodeCdr(message, bytes);
  const std::string data(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  core::WriteText(log(),
                  test::McapFile(test::McapSchema(1, "interfaces/msg/JointState", "", "") +
                                 test::McapSchema(2, "our_msgs/msg/Secret", "", "") +
                                 test::McapChannel(1, 1, "/joint_states", "cdr") +
                                 test::McapChannel(2, 2, "/secret", "cdr") +
                                 test::McapMessage(1, 5, data) + test::McapMessage(2, 5, data)));
  const test::ProgramEnd end = Run({"log.mcap", "-o", "copy.mcap"});
  EXPECT_EQ(end.output,
            "/secret: without a definition: no definition of our_msgs/msg/Secret in the bag, below "
            "--msg-path or built in\ncopy.mcap: 2 messages\n");
  const auto copy = logs::OpenLog(folder() / "copy.mcap");
  const logs::LogChannel& joints = copy->contents().channels[0];
  ASSERT_TRUE(joints.schema.has_value());
  EXPECT_EQ(joints.schema->encoding, "ros2msg");
  logs::TypeChoice choice = logs::TypeResolver().Resolve(logs::SchemaOf(joints));
  choice.Show(bytes);
  EXPECT_EQ(choice.Report(), "the bag");
  EXPECT_EQ(copy->contents().channels[1].type_name, "our_msgs/msg/Secret");
}

// A bag of sqlite3, of which neither yaml nor database has definitions.
TEST_F(Export, SqliteBagsBecomeMcap) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const fs::path bag = fs::path(data) / "logs/go2_vicon_orl/test_6_vicon_bag";
  const test::ProgramEnd end = Run({bag.string(), "-o", "copy.mcap"});
  EXPECT_EQ(end.output, "copy.mcap: 7396 messages\n");
  const auto original = logs::OpenLog(bag);
  const auto copy = logs::OpenLog(folder() / "copy.mcap");
  std::vector<Copied> ours = MessagesOf(*copy), theirs = MessagesOf(*original);
  for (auto* messages : {&ours, &theirs}) {
    for (Copied& message : *messages) {
      message.publish_time_ns.reset();  // which the bag has not
      message.sequence.reset();
    }
  }
  EXPECT_EQ(ours, theirs);
  EXPECT_EQ(copy->contents().channels[0].metadata, original->contents().channels[0].metadata);
  const logs::LogSurvey survey = logs::SurveyLog(*copy, logs::TypeResolver());
  EXPECT_EQ(survey.channels[0].type.Report(), "the bag");
  EXPECT_EQ(survey.channels[0].undecoded, 0u);
}

// --- What scoria logs itself ---

class ExportOfAWalk : public Export {
 protected:
  void SetUp() override {
    RunOptions options;
    options.folder = folder();
    (void)RunToFolder(test::LoadScenario("flat", {"duration_s=2", "start=standing"}), options);
  }
};

TEST_F(ExportOfAWalk, SignalsAreTheRows) {
  const test::ProgramEnd end = Run({"log.mcap", "-o", "signals.csv", "--signals"});
  EXPECT_EQ(end.output, "signals.csv: 1000 rows\n");
  const std::vector<Texts> lines = ReadCsv(folder() / "signals.csv");
  ASSERT_EQ(lines.size(), 1001u);
  std::map<std::string, std::size_t> columns;
  for (std::size_t i = 0; i < lines[0].size(); ++i) columns[lines[0][i]] = i;
  std::size_t i = 1;
  const auto number = [&](const char* column) {
    return std::strtod(lines[i].at(columns.at(column)).c_str(), nullptr);
  };
  EXPECT_EQ(logs::ForEachRow(log(),
                             [&](const logs::Row& row) {
                               EXPECT_EQ(number("time_s"), row.time_s);
                               EXPECT_EQ(number("truth.v_WB_mps[0]"), row.truth->v_WB_mps[0]);
                               EXPECT_EQ(number("measured.q_rad[7]"), (*row.measured->q_rad)[7]);
                               EXPECT_EQ(number("episode.step"), row.episode->step);
                               EXPECT_EQ(lines[i][columns.at("solve_times.mpc_s")].empty(),
                                         !row.solve_times->mpc_s.has_value());
                               ++i;
                             }),
            "");
  EXPECT_EQ(i, 1001u);
}

TEST_F(ExportOfAWalk, CopyOfTheLogIsVerified) {
  EXPECT_EQ(Run({"log.mcap", "-o", "copy.mcap"}).code, 0);
  const VerifyResult result = VerifyLog(folder() / "copy.mcap");
  EXPECT_TRUE(result.identical) << result.difference;
  EXPECT_EQ(result.messages, VerifyLog(log()).messages);
}

// --- What is refused, and what is left behind ---

TEST_F(Export, AnswersMistakesInWords) {
  WriteLog(3);
  const auto error = [&](const std::vector<std::string>& arguments) {
    const test::ProgramEnd end = Run(arguments);
    EXPECT_EQ(end.code, 2);
    return end.output;
  };
  EXPECT_EQ(error({"log.mcap", "-o", "csv", "--topics", "/joint_state"}),
            "log.mcap: has no topic \"/joint_state\" (did you mean \"/joint_states\"?); scoria "
            "info lists them\n");
  EXPECT_EQ(error({"log.mcap", "-o", "one.csv"}),
            "one.csv: 2 topics do not fit into one file; name a folder, or one topic with "
            "--topics\n");
  EXPECT_EQ(error({"log.mcap", "-o", "csv", "--from", "100"}),
            "log.mcap: has no message in what is asked for\n");
  EXPECT_EQ(error({"log.mcap", "-o", ".", "--format", "mcap"}), ".: is a folder; name a file\n");
  EXPECT_TRUE(error({"log.mcap", "-o", "rows.csv", "--signals"})
                  .ends_with("; write one (docs/mappings.md) or draft one: scoria info LOG "
                             "--draft-mapping FILE\n"));
  EXPECT_NE(error({"log.mcap", "-o", "a", "--signals", "--topics", "/a"}).find("--topics"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder() / "csv"));
}

TEST_F(Export, SignalsOfAFieldLogByItsMapping) {
  const std::string log = test::SourcePath("samples/go2_walk.mcap").string();
  const fs::path all = folder() / "all.csv", part = folder() / "part.csv";
  EXPECT_EQ(test::RunScoria({"export", log, "--signals", "-o", all.string()}).code, 0);
  EXPECT_EQ(test::RunScoria({"export", log, "--signals", "-o", part.string(), "--mapping",
                             "dfki_quad", "--from", "1", "--to", "1.1"})
                .code,
            0);
  const auto lines = [](const fs::path& file) {
    const std::string text = core::ReadText(file);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(all), 901);
  EXPECT_EQ(lines(part), 27) << "a header and 26 rows at 250 Hz";
  EXPECT_NE(core::ReadText(all).find("measured.q_rad[0]"), std::string::npos);
}

TEST_F(Export, OverwritesOnlyByForce) {
  WriteLog(3);
  for (const char* out : {"joint_states.csv", "copy.mcap"}) {
    core::WriteText(folder() / out, "mine");
    const std::vector<std::string> arguments = {"log.mcap", "-o", out, "--topics", "/joint_states"};
    const test::ProgramEnd end = Run(arguments);
    EXPECT_EQ(end.code, 2);
    EXPECT_EQ(end.output, fmt::format("{}: exists; --force overwrites it\n", out));
    EXPECT_EQ(core::ReadText(folder() / out), "mine");
    std::vector<std::string> forced = arguments;
    forced.emplace_back("--force");
    EXPECT_EQ(Run(forced).code, 0);
    EXPECT_GT(core::ReadText(folder() / out).size(), 100u);
  }
}

int FilesIn(const fs::path& folder) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files += entry.is_regular_file() ? 1 : 0;
  return files;
}

TEST_F(Export, InterruptedLeavesNothing) {
  WriteLog(3);
  const std::atomic<bool> interrupted = true;
  ExportOptions options;
  options.log = log();
  options.interrupted = &interrupted;
  options.out = folder() / "csv";
  EXPECT_TRUE(ExportCsv(options).was_interrupted);
  options.out = folder() / "copy.mcap";
  EXPECT_TRUE(ExportMcap(options).was_interrupted);
  EXPECT_EQ(FilesIn(folder()), 1) << "the log itself";
}

// A limit on the size of files stands for the end of the disk.
TEST_F(Export, FullDiskIsAnErrorInWordsAndLeavesNothing) {
  WriteLog(2000);
  constexpr rlim_t kLargest = 200'000;
  for (const char* out : {"csv", "copy.mcap"}) {
    const test::ProgramEnd end = Run({"log.mcap", "-o", out}, kLargest);
    EXPECT_EQ(end.code, 4) << out;
    EXPECT_NE(end.output.find(": cannot write: file too large\n"), std::string::npos) << end.output;
    EXPECT_EQ(FilesIn(folder()), 1) << out;
  }
}

// --- Damaged logs of others ---

TEST_F(Export, DamagedLogsAreExportedAsFarAsTheyGo) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const fs::path broken = fs::path(data) / "mcap/broken";
  for (const char* name : {"flipped_byte_in_chunk", "truncated_60pct", "bad_start_magic"}) {
    const std::string file = (broken / name).string() + ".mcap";
    const std::string out = (folder() / name).string() + ".mcap";
    const test::ProgramEnd end = Run({file, "-o", out});
    EXPECT_EQ(end.code, 0) << name;
    const auto original = logs::OpenLog(file);
    const auto copy = logs::OpenLog(out);
    EXPECT_EQ(MessagesOf(*copy), MessagesOf(*original)) << name;
    EXPECT_TRUE(copy->problems().empty()) << name;
    for (const logs::LogProblem& problem : original->problems())
      EXPECT_NE(end.output.find(problem.what), std::string::npos) << end.output;
  }
}

}  // namespace
}  // namespace scoria::app
