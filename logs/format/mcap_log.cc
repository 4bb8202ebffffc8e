// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_log.h"

#include <algorithm>

#include <fmt/format.h>

#include "logs/format/mcap_cursor.h"

namespace scoria::logs {
namespace {

using namespace mcap_format;  // this file reads the format

/// Whether the blocks that are open at one time stay small enough to be read in the order of time.
bool CanBeOrdered(const std::vector<Block>& blocks) {
  constexpr std::uint64_t kMost = 256 << 20;
  std::vector<std::pair<std::int64_t, std::int64_t>> changes;  // time, bytes
  for (const Block& block : blocks) {
    const auto size = static_cast<std::int64_t>(block.length + block.unpacked_size);
    changes.emplace_back(block.span.first_ns, size);
    changes.emplace_back(block.span.last_ns, -size);
  }
  // At equal times what begins comes before what ends.
  std::sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  });
  std::int64_t held = 0, largest = 0;
  for (const auto& change : changes) largest = std::max(largest, held += change.second);
  return largest <= static_cast<std::int64_t>(kMost);
}

void Include(std::optional<LogSpan>& span, const LogSpan& other) {
  if (!span) span = other;
  span->first_ns = std::min(span->first_ns, other.first_ns);
  span->last_ns = std::max(span->last_ns, other.last_ns);
}

class McapLog final : public LogSource {
 public:
  explicit McapLog(const LogFile& file) : file_(file.path, file.shown), index_(ReadIndex(file_)) {
    contents_.path = file.shown;
    for (const LogProblem& problem : file.problems) problems_.Add(problem);
    contents_.format = "an MCAP log";
    if (!StartsWithMagic(file_.Read(0, kMagic.size())))
      Report(LogProblem::Kind::kOdd, "its first bytes are damaged");
    for (LogProblem& problem : index_.problems) problems_.Add(std::move(problem));
    for (const auto& [id, record] : index_.definitions.channels()) {
      channel_indexes_[id] = contents_.channels.size();
      contents_.channels.push_back(ToChannel(record));
    }
    AddExtents();
    contents_.can_order_by_time = CanBeOrdered(index_.blocks);
    for (const std::uint64_t offset : index_.metadata) AddMetadata(offset);
    for (const RecordPlace& a : index_.attachments) contents_.attachments.push_back(a.name);
  }

  [[nodiscard]] const LogContents& contents() const override { return contents_; }
  [[nodiscard]] const std::vector<LogProblem>& problems() const override {
    return problems_.problems();
  }
  [[nodiscard]] std::unique_ptr<LogCursor> Read(const LogFilter& filter) override {
    return std::make_unique<McapCursor>(
        McapView{file_, index_, contents_, channel_indexes_, problems_}, filter);
  }

  [[nodiscard]] std::optional<LogAttachment> ReadAttachment(const std::string& name) override {
    const auto found = std::find_if(index_.attachments.begin(), index_.attachments.end(),
                                    [&](const RecordPlace& a) { return a.name == name; });
    if (found == index_.attachments.end()) return std::nullopt;
    try {
      const RecordHead head = ParseHead(file_.Read(found->offset, kRecordHead));
      return ParseAttachment(file_.Read(found->offset + kRecordHead, head.length));
    } catch (const RecordError& e) {
      throw std::runtime_error(
          fmt::format("{}: at byte {}: {}", file_.path().string(), found->offset, e.what()));
    }
  }

 private:
  void Report(LogProblem::Kind kind, std::string what) {
    problems_.Add({kind, file_.path(), std::move(what)});
  }

  [[nodiscard]] LogChannel ToChannel(const ChannelRecord& record) {
    LogChannel channel;
    channel.topic = record.topic;
    channel.message_encoding = record.message_encoding;
    channel.metadata = record.metadata;
    const auto schema = index_.definitions.schemas().find(record.schema_id);
    if (schema != index_.definitions.schemas().end()) {
      channel.type_name = schema->second.name;
      channel.schema = schema->second.schema;
    } else if (record.schema_id != 0) {
      Report(LogProblem::Kind::kOdd,
             fmt::format("channel {} ({}) is of schema {}, which the file does not define",
                         record.id, record.topic, record.schema_id));
    }
    return channel;
  }

  void AddExtents() {
    const bool all_known = std::all_of(index_.blocks.begin(), index_.blocks.end(),
                                       [](const Block& b) { return b.channels.has_value(); });
    if (all_known) {
      for (LogChannel& channel : contents_.channels) channel.message_count = 0;
    }
    for (const Block& block : index_.blocks) {
      Include(contents_.span, block.span);
      if (!all_known) continue;
      for (const ChannelExtent& extent : *block.channels) {
        const auto at = channel_indexes_.find(extent.channel_id);
        if (at == channel_indexes_.end()) continue;  // reading it says so
        LogChannel& channel = contents_.channels[at->second];
        *channel.message_count += extent.count;
        Include(channel.span, extent.span);
      }
    }
  }

  void AddMetadata(std::uint64_t offset) {
    try {
      const RecordHead head = ParseHead(file_.Read(offset, kRecordHead));
      if (head.length > kLargestRecord) throw RecordError("a record claims more than 256 MiB");
      auto [name, entries] = ParseMetadata(file_.Read(offset + kRecordHead, head.length));
      contents_.metadata.insert_or_assign(std::move(name), std::move(entries));
    } catch (const RecordError& e) {
      Report(LogProblem::Kind::kLost, fmt::format("at byte {}: metadata: {}", offset, e.what()));
    }
  }

  RandomAccessFile file_;
  Index index_;
  LogContents contents_;
  std::unordered_map<std::uint16_t, std::size_t> channel_indexes_;
  ProblemList problems_;
};

}  // namespace

bool IsMcap(std::span<const std::byte> first, std::span<const std::byte> last) {
  return StartsWithMagic(first) || EndsWithMagic(last);
}

std::unique_ptr<LogSource> OpenMcap(const LogFile& file) { return std::make_unique<McapLog>(file); }

}  // namespace scoria::logs
