// SPDX-License-Identifier: BSD-3-Clause
#include "logs/read_rows.h"

#include <map>

#include <gtest/gtest.h>

#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/messages/scoria.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// Writes rows as the recorder does, and what a test wants otherwise.
class RowLog {
 public:
  explicit RowLog(const fs::path& path) : writer_(path) {}

  void AddRowMetadata() { writer_.AddMetadata(kRowMetadata, MakeRowMetadata("9.9.9")); }
  void AddMetadata(const std::string& name, const LogMetadata& metadata) {
    writer_.AddMetadata(name, metadata);
  }
  /// @param schema  in place of the group's own.
  template <class Group>
  void WriteGroup(double time_s, const Group& group, const std::string& schema = "") {
    RowMessage<Group> message{time_s, group};
    Write(TopicOf(Group::kGroup), time_s, message, schema);
  }
  template <class Message>
  void Write(const std::string& topic, double time_s, Message message,
             const std::string& schema = "") {
    if (!channels_.contains(topic))
      channels_[topic] = writer_.AddChannel(
          topic, Message::kTypeName, schema.empty() ? SchemaWriter::SchemaOf<Message>() : schema);
    Bytes bytes;
    EncodeCdr(message, bytes);
    writer_.Write(channels_[topic], std::llround(time_s * 1e9), bytes);
  }
  void WriteRow(const Row& row) {
    ForEachGroup(row, [&](const auto& group) {
      if (group) WriteGroup(row.time_s, *group);
    });
  }

 private:
  McapWriter writer_;
  std::map<std::string, std::uint16_t> channels_;
};

Row RowAt(int i) {
  Row row = test::WholeRow();
  row.time_s = 0.002 * i;
  row.episode->step = 2 * i;
  row.truth->p_WB_m = {0.001 * i, 0.0, 0.3};
  row.estimate->p_WB_m = {0.0011 * i, 0.0, 0.3};
  if (i % 5 != 0) row.solve_times = SolveTimesRow{};  // nothing was solved
  if (i % 7 == 0) row.contacts.reset();
  return row;
}

TEST(ReadRows, GroupsOfOneInstantAreOneRow) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    log.AddRowMetadata();
    for (int i = 0; i < 100; ++i) {
      log.WriteRow(RowAt(i));
      if (i == 40) log.Write("/scoria/event", 0.08, msg::Event{80, "fall", "tilt"});
    }
  }
  int i = 0;
  EXPECT_EQ(ForEachRow(path, [&](const Row& row) { EXPECT_TRUE(row == RowAt(i++)) << i; }), "");
  EXPECT_EQ(i, 100);
  const LogContent content = ReadLog(path, 4);
  EXPECT_EQ(content.problem, "");
  ASSERT_EQ(content.rows.size(), 25u);
  EXPECT_EQ(content.rows[3], RowAt(12));
  EXPECT_EQ(content.falls_s, std::vector<double>{0.08});
}

TEST(ReadRows, GroupThatIsNotInTheLogIsAbsent) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    for (int i = 0; i < 10; ++i) {
      Row row = RowAt(i);
      test::DropTruth(row);
      log.WriteRow(row);
    }
  }
  const LogContent content = ReadLog(path);
  EXPECT_EQ(content.problem, "");
  ASSERT_EQ(content.rows.size(), 10u);
  EXPECT_FALSE(content.rows[1].truth.has_value());
  EXPECT_TRUE(content.rows[1].estimate.has_value());
}

// Never decoded into plausible garbage: the group is left out, and the reader is told why.
TEST(ReadRows, GroupOfAnotherSchemaIsLeftOutAndNamed) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    log.AddRowMetadata();
    const std::string ours = SchemaWriter::SchemaOf<RowMessage<CommandRow>>();
    std::string theirs = ours;
    theirs.replace(theirs.find("float64 v_y_mps"), 7, "float32");
    log.WriteGroup(0.5, CommandRow{1.0, 2.0, 3.0}, theirs);
    log.WriteGroup(0.5, ModelRow{15.0},
                   SchemaWriter::SchemaOf<RowMessage<ModelRow>>() + "bool more\n");
    log.WriteGroup(0.5, EpisodeRow{250, true}, "float64 time_s\n");
    log.WriteGroup(0.5, SupervisionRow{});
    log.Write("/scoria/row/weather", 0.5, msg::Event{});
  }
  const LogContent content = ReadLog(path);
  ASSERT_EQ(content.rows.size(), 1u);
  EXPECT_EQ(GroupsOf(content.rows[0]).count(), 1u);
  EXPECT_TRUE(content.rows[0].supervision.has_value());
  EXPECT_EQ(
      content.problem,
      path.string() +
          ": /scoria/row/command, written by scoria 9.9.9, is left out: it has \"float32 "
          "v_y_mps\" where this version has \"float64 v_y_mps\"; /scoria/row/episode, written by "
          "scoria 9.9.9, is left out: it lacks \"int64 step\"; /scoria/row/model, written by "
          "scoria 9.9.9, is left out: it has \"bool more\", which this version does not know; "
          "/scoria/row/weather, written by scoria 9.9.9, is left out: this version does not "
          "know it");
}

TEST(ReadRows, RowsInOneMessageAreRefused) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    log.AddMetadata("scoria", {{"version", "0.1.0"}});
    log.Write("/scoria/row", 0.0, msg::Event{1, "any", "thing"});
  }
  const LogContent content = ReadLog(path);
  EXPECT_TRUE(content.rows.empty());
  EXPECT_EQ(
      content.problem,
      path.string() +
          ": /scoria/row, written by scoria 0.1.0, is left out: rows in one message, as version "
          "0.1.0 wrote them, are not read; walk its scenario again");
}

TEST(ReadRows, AnotherLayoutIsRefusedWhole) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    log.AddMetadata(kRowMetadata, {{"schema_version", "77"}, {"version", "8.0"}});
    log.WriteRow(RowAt(1));
  }
  const LogContent content = ReadLog(path);
  EXPECT_TRUE(content.rows.empty());
  EXPECT_EQ(content.problem, path.string() +
                                 ": its rows are of layout 77, written by scoria 8.0; this version "
                                 "reads layout 2");
}

TEST(ReadRows, TimeThatGoesBackIsNamed) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mcap";
  {
    RowLog log(path);
    for (const int i : {1, 2, 3, 2}) log.WriteRow(RowAt(i));
  }
  const LogContent content = ReadLog(path);
  EXPECT_EQ(content.rows.size(), 4u);
  EXPECT_EQ(content.problem, path.string() + ": the rows go back in time, to 0.004 s");
}

}  // namespace
}  // namespace scoria::logs
