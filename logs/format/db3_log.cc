// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/db3_log.h"

#include <utility>

#include <fmt/format.h>

#include "logs/format/db3_database.h"
#include "logs/format/db3_rows.h"
#include "logs/format/db3_tables.h"
#include "logs/format/problem_list.h"
#include "logs/format/zstd_frames.h"

namespace scoria::logs {
namespace {

/// What a cursor reads from; all borrowed.
struct Db3View {
  const std::filesystem::path& file;
  const SqliteDatabase& database;
  const LogContents& contents;
  const std::map<std::int64_t, std::size_t>& channel_of_topic;
  bool is_sorted;  // by time, as stored
  ProblemList& problems;
};

class Db3Cursor final : public LogCursor {
 public:
  Db3Cursor(const Db3View& view, LogFilter filter)
      : view_(view),
        filter_(std::move(filter)),
        rows_(view.database, OrderOf(view, filter_)),
        data_(view.database) {
    for (const LogChannel& channel : view_.contents.channels)
      wanted_.push_back(filter_.HasTopic(channel.topic));
  }

  std::optional<LogMessage> Next() override {
    while (const std::optional<Db3Row> row = rows_.Next()) {
      if (view_.is_sorted && row->time_ns > filter_.to_ns) break;
      const auto channel = view_.channel_of_topic.find(row->topic_id);
      if (channel == view_.channel_of_topic.end() || !wanted_[channel->second] ||
          row->time_ns < filter_.from_ns || row->time_ns > filter_.to_ns)
        continue;
      const LogChannel& of = view_.contents.channels[channel->second];
      if (const auto data = DataOf(*row, of))
        return LogMessage{channel->second, of, row->time_ns, std::nullopt, std::nullopt, *data};
    }
    return std::nullopt;
  }

 private:
  static LogOrder OrderOf(const Db3View& view, const LogFilter& filter) {
    const bool is_to_sort = !view.is_sorted && view.contents.can_order_by_time;
    return is_to_sort ? filter.order : LogOrder::kStored;
  }

  std::optional<std::span<const std::byte>> DataOf(const Db3Row& row, const LogChannel& channel) {
    try {
      const auto data = unpacker_.Unpack(data_.Of(row));
      if (!data)
        Report(fmt::format("messages of {} are lost: they do not decompress", channel.topic));
      return data;
    } catch (const SqliteError& e) {
      Report(fmt::format("messages of {} are lost: {}", channel.topic, e.what()));
      return std::nullopt;
    }
  }
  void Report(std::string what) {
    view_.problems.Add({LogProblem::Kind::kLost, view_.file, std::move(what)});
  }

  Db3View view_;
  LogFilter filter_;
  Db3Rows rows_;
  Db3Data data_;
  MessageUnpacker unpacker_;
  std::vector<bool> wanted_;  // by channel
};

class Db3Log final : public LogSource {
 public:
  explicit Db3Log(const LogFile& file) : file_(file.shown), database_(OpenDb3Database(file)) {
    for (LogProblem& problem : database_.problems) problems_.Add(std::move(problem));
    Db3Tables tables = ReadDb3Tables(database_.database);
    channel_of_topic_ = std::move(tables.channel_of_topic);
    contents_.path = file_;
    contents_.format = "a rosbag2 bag (sqlite3)";
    contents_.channels = std::move(tables.channels);
    if (!tables.metadata.empty()) contents_.metadata["rosbag2"] = std::move(tables.metadata);
    for (LogChannel& channel : contents_.channels) channel.message_count = 0;
    Count();
  }

  [[nodiscard]] const LogContents& contents() const override { return contents_; }
  [[nodiscard]] const std::vector<LogProblem>& problems() const override {
    return problems_.problems();
  }
  [[nodiscard]] std::unique_ptr<LogCursor> Read(const LogFilter& filter) override {
    return std::make_unique<Db3Cursor>(
        Db3View{file_, database_.database, contents_, channel_of_topic_, is_sorted_, problems_},
        filter);
  }
  [[nodiscard]] std::optional<LogAttachment> ReadAttachment(const std::string&) override {
    return std::nullopt;  // the format has none
  }

 private:
  /// Counts the rows that can be read. Of a database that is cut also their bytes have to be there.
  void Count() {
    Db3Rows rows(database_.database, LogOrder::kStored);
    Db3Data data(database_.database);
    std::map<std::int64_t, std::uint64_t> unknown;  // rows by topics.id
    std::uint64_t without_data = 0;
    std::optional<std::int64_t> last_ns;
    while (const std::optional<Db3Row> row = rows.Next()) {
      if (database_.is_cut && !HasData(data, *row)) {
        ++without_data;
        continue;
      }
      is_sorted_ = is_sorted_ && (!last_ns || row->time_ns >= *last_ns);
      last_ns = row->time_ns;
      const auto channel = channel_of_topic_.find(row->topic_id);
      if (channel == channel_of_topic_.end()) {
        ++unknown[row->topic_id];
        continue;
      }
      Include(contents_.channels[channel->second], row->time_ns);
      ++count_;
    }
    contents_.can_order_by_time = is_sorted_ || rows.gaps().empty();
    for (const auto& [id, count] : unknown)
      Report(fmt::format("{} messages of topic number {} are lost: the bag does not define it",
                         count, id));
    if (without_data > 0)
      Report(fmt::format("{} messages are lost: their bytes are not all there", without_data));
    for (const Db3Gap& gap : rows.gaps()) Report(GapText(gap));
  }

  static bool HasData(Db3Data& data, const Db3Row& row) {
    try {
      static_cast<void>(data.Of(row));
      return true;
    } catch (const SqliteError&) {
      return false;
    }
  }

  void Include(LogChannel& channel, std::int64_t time_ns) {
    ++*channel.message_count;
    for (std::optional<LogSpan>* span : {&channel.span, &contents_.span}) {
      if (!*span) *span = LogSpan{time_ns, time_ns};
      (*span)->first_ns = std::min((*span)->first_ns, time_ns);
      (*span)->last_ns = std::max((*span)->last_ns, time_ns);
    }
  }

  [[nodiscard]] std::string GapText(const Db3Gap& gap) const {
    constexpr double kS = 1e-9;
    if (gap.last_id)
      return fmt::format("rows {} to {} cannot be read ({})", gap.first_id, *gap.last_id, gap.why);
    if (count_ == 0) return fmt::format("no message can be read ({})", gap.why);
    return fmt::format(
        "nothing can be read from row {} on ({}); {} messages are there, the last {:.3f} s after "
        "the first",
        gap.first_id, gap.why, count_,
        kS * static_cast<double>(contents_.span->last_ns - contents_.span->first_ns));
  }

  void Report(std::string what) {
    problems_.Add({LogProblem::Kind::kLost, file_, std::move(what)});
  }

  std::filesystem::path file_;
  Db3Database database_;
  LogContents contents_;
  std::map<std::int64_t, std::size_t> channel_of_topic_;
  bool is_sorted_ = true;
  std::uint64_t count_ = 0;
  ProblemList problems_;
};

}  // namespace

std::unique_ptr<LogSource> OpenDb3(const LogFile& file) {
  try {
    return std::make_unique<Db3Log>(file);
  } catch (const NoBagError& e) {
    throw std::runtime_error(
        fmt::format("{}: is an SQLite database, not a bag: {}", file.shown.string(), e.what()));
  } catch (const SqliteError& e) {
    throw std::runtime_error(fmt::format("{}: is an SQLite database that is damaged: {}",
                                         file.shown.string(), e.what()));
  }
}

}  // namespace scoria::logs
