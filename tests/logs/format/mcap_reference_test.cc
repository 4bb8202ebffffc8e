// SPDX-License-Identifier: BSD-3-Clause
// MCAP files that others wrote, and what independent readers say that they hold.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "logs/format/open_log.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class McapReference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SCORIA_REFERENCE_DATA");
    if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
    folder_ = fs::path(data) / "mcap";
  }
  fs::path folder_;
};

json ReadJson(const fs::path& path) {
  std::ifstream in(path);
  return json::parse(in);
}

std::string ToHex(std::span<const std::byte> data) {
  std::string hex;
  for (const std::byte b : data) hex += fmt::format("{:02x}", static_cast<unsigned>(b));
  return hex;
}

std::vector<fs::path> McapFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

/// One record of the conformance suite's JSON.
struct Record {
  std::string type;
  std::map<std::string, json> fields;
  explicit Record(const json& from) : type(from.at("type")) {
    for (const json& field : from.at("fields")) fields[field.at(0)] = field.at(1);
  }
  [[nodiscard]] std::int64_t Int(const char* field) const {
    return std::stoll(fields.at(field).get<std::string>());
  }
  [[nodiscard]] std::string Text(const char* field) const { return fields.at(field); }
  [[nodiscard]] std::string Bytes(const char* field) const {
    std::string bytes;
    for (const json& b : fields.at(field))
      bytes += static_cast<char>(std::stoi(b.get<std::string>()));
    return bytes;
  }
};

/// What the suite expects of a log's contents.
class Expected {
 public:
  explicit Expected(const fs::path& file) {
    const json expected = ReadJson(file);
    for (const json& record : expected.at("records")) Take(Record(record));
    std::stable_sort(messages_.begin(), messages_.end(), [](const Record& a, const Record& b) {
      return a.Int("log_time") < b.Int("log_time");
    });
  }

  void Compare(LogSource& log) const {
    ASSERT_EQ(log.contents().channels.size(), channels_.size());
    std::size_t at = 0;
    for (const auto& [id, record] : channels_)
      CompareChannel(log.contents().channels[at++], record);
    at = 0;
    log.ForEach({}, [&](const LogMessage& m) {
      ASSERT_LT(at, messages_.size());
      CompareMessage(m, messages_[at++]);
    });
    EXPECT_EQ(at, messages_.size());
    for (const Record& a : attachments_) {
      const std::optional<LogAttachment> found = log.ReadAttachment(a.Text("name"));
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->media_type, a.Text("media_type"));
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(found->data.data()), found->data.size()),
                a.Bytes("data"));
    }
    for (const Record& m : metadata_) {
      EXPECT_EQ(log.contents().metadata.at(m.Text("name")),
                m.fields.at("metadata").get<LogMetadata>());
    }
    EXPECT_EQ(ProblemText(log.problems()), "");
  }
  [[nodiscard]] std::size_t messages() const { return messages_.size(); }

 private:
  void Take(const Record& record) {
    if (record.type == "Schema") schemas_.try_emplace(record.Int("id"), record);
    if (record.type == "Channel") channels_.try_emplace(record.Int("id"), record);
    if (record.type == "Message") messages_.push_back(record);
    if (record.type == "Attachment") attachments_.push_back(record);
    if (record.type == "Metadata") metadata_.push_back(record);
  }

  void CompareChannel(const LogChannel& channel, const Record& record) const {
    EXPECT_EQ(channel.topic, record.Text("topic"));
    EXPECT_EQ(channel.message_encoding, record.Text("message_encoding"));
    EXPECT_EQ(channel.metadata, record.fields.at("metadata").get<LogMetadata>());
    const std::int64_t schema_id = record.Int("schema_id");
    EXPECT_EQ(channel.schema.has_value(), schema_id != 0);
    if (schema_id == 0) return;
    const Record& schema = schemas_.at(schema_id);
    EXPECT_EQ(channel.type_name, schema.Text("name"));
    EXPECT_EQ(channel.schema, (LogSchema{schema.Text("encoding"), schema.Bytes("data")}));
    const auto of_channel = [&](const Record& m) {
      return m.Int("channel_id") == record.Int("id");
    };
    EXPECT_EQ(channel.message_count, static_cast<std::uint64_t>(std::count_if(
                                         messages_.begin(), messages_.end(), of_channel)));
  }

  static void CompareMessage(const LogMessage& m, const Record& record) {
    EXPECT_EQ(m.log_time_ns, record.Int("log_time"));
    EXPECT_EQ(m.publish_time_ns, record.Int("publish_time"));
    EXPECT_EQ(m.sequence, record.Int("sequence"));
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(m.data.data()), m.data.size()),
              record.Bytes("data"));
  }

  std::map<std::int64_t, Record> schemas_, channels_;
  std::vector<Record> messages_, attachments_, metadata_;
};

TEST_F(McapReference, ConformanceSuiteIsReadToTheLastByte) {
  std::size_t messages = 0;
  for (const fs::path& file : McapFilesIn(folder_ / "conformance")) {
    SCOPED_TRACE(file);
    const Expected expected(fs::path(file).replace_extension(".json"));
    expected.Compare(*OpenLog(file));
    messages += expected.messages();
  }
  EXPECT_GT(messages, 1000u);
}

/// Counts, first bytes and last time of every topic, by the writer's own account.
TEST_F(McapReference, EveryCompressionAndOrderHoldsTheSame) {
  for (const fs::path& file : McapFilesIn(folder_ / "compressed")) {
    SCOPED_TRACE(file);
    const json expected = ReadJson(fs::path(file).replace_extension(".expected.json"));
    const std::unique_ptr<LogSource> log = OpenLog(file);
    EXPECT_TRUE(log->contents().can_order_by_time);
    ASSERT_EQ(log->contents().channels.size(), expected.at("topics").size());
    std::map<std::string, std::uint64_t> counts;
    std::map<std::string, std::string> first;
    std::int64_t last_ns = 0;
    log->ForEach({}, [&](const LogMessage& m) {
      EXPECT_GE(m.log_time_ns, last_ns);
      last_ns = m.log_time_ns;
      if (counts[m.channel.topic]++ == 0) first[m.channel.topic] = ToHex(m.data);
    });
    for (const json& topic : expected.at("topics")) {
      const std::string name = topic.at("topic");
      const auto& channels = log->contents().channels;
      const auto channel = std::find_if(channels.begin(), channels.end(),
                                        [&](const LogChannel& c) { return c.topic == name; });
      ASSERT_NE(channel, channels.end()) << name;
      EXPECT_EQ(channel->type_name, topic.at("type"));
      EXPECT_EQ(channel->schema, (LogSchema{"ros2msg", topic.at("schema")}));
      EXPECT_EQ(channel->message_count, topic.at("count"));
      EXPECT_EQ(counts[name], topic.at("count")) << name;
      EXPECT_EQ(first[name], topic.at("first_hex")) << name;
      EXPECT_EQ(channel->span->last_ns, std::stoll(topic.at("last_log_time").get<std::string>()));
    }
    EXPECT_EQ(ProblemText(log->problems()), "");
  }
}

/// Cut in chunks, message indexes, the summary and the footer.
TEST_F(McapReference, CutFilesGiveTheMoreTheLongerTheyAre) {
  const char* temporary = "scoria_mcap_reference_cut.mcap";
  const fs::path cut = fs::temp_directory_path() / temporary;
  for (const fs::path& file : McapFilesIn(folder_ / "compressed")) {
    SCOPED_TRACE(file);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::size_t last = 0;
    for (std::size_t size = 1000; size < bytes.size(); size += bytes.size() / 97) {
      std::ofstream(cut, std::ios::binary) << bytes.substr(0, size);
      const std::unique_ptr<LogSource> log = OpenLog(cut);
      std::size_t count = 0;
      log->ForEach({}, [&](const LogMessage&) { ++count; });
      EXPECT_GE(count, last) << size;
      EXPECT_TRUE(count == 1246 || LosesData(log->problems())) << size;
      last = count;
    }
    EXPECT_EQ(last, 1246u) << "a cut in the summary loses nothing";
  }
  fs::remove(cut);
}

struct Outcome {
  std::size_t messages = 0;
  std::string problems;  // or why it cannot be opened, without the folder
};

Outcome ReadBroken(const fs::path& file) {
  Outcome outcome;
  try {
    const std::unique_ptr<LogSource> log = OpenLog(file);
    log->ForEach({}, [&](const LogMessage&) { ++outcome.messages; });
    outcome.problems = ProblemText(log->problems());
  } catch (const std::runtime_error& e) {
    outcome.problems = e.what();
  }
  const std::string folder = file.parent_path().string() + "/";
  if (outcome.problems.starts_with(folder)) outcome.problems.erase(0, folder.size());
  return outcome;
}

/// All are of 1246 messages. An independent reader had 723 of the cut one.
TEST_F(McapReference, BrokenFilesGiveWhatTheyHaveAndSayTheRest) {
  const std::map<std::string, std::pair<std::size_t, std::string>> expected = {
      {"bad_start_magic.mcap", {1246, "bad_start_magic.mcap: its first bytes are damaged"}},
      {"empty.mcap", {0, "empty.mcap: is empty"}},
      {"flipped_byte_in_chunk.mcap",
       {1097,
        "flipped_byte_in_chunk.mcap: at byte 16728: chunk has a wrong checksum; 149 messages are "
        "lost, 0.200 s to 0.430 s after the log's first"}},
      {"truncated_60pct.mcap",
       {723, "truncated_60pct.mcap: cut off at byte 86787; everything before it was read"}}};
  for (const fs::path& file : McapFilesIn(folder_ / "broken")) {
    const Outcome outcome = ReadBroken(file);
    EXPECT_FALSE(outcome.problems.empty()) << file;
    const auto known = expected.find(file.filename().string());
    if (known == expected.end()) continue;
    EXPECT_EQ(outcome.messages, known->second.first);
    EXPECT_EQ(outcome.problems, known->second.second);
  }
}

}  // namespace
}  // namespace scoria::logs
