// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "logs/format/mcap_index.h"

namespace scoria::logs::mcap_format {
namespace {

constexpr std::size_t kFooterBody = 8 + 8 + 4;
constexpr std::size_t kTail = kRecordHead + kFooterBody + kMagic.size();

struct Footer {
  std::uint64_t offset = 0;         // of its record
  std::uint64_t summary_start = 0;  // 0: no summary
  std::uint32_t crc = 0;            // of the summary and of itself up to here; 0: none
};

/// Nothing if the file does not end as an MCAP file does.
std::optional<Footer> ReadFooter(const RandomAccessFile& file) {
  if (file.size() < kMagic.size() + kTail) return std::nullopt;
  Footer footer;
  footer.offset = file.size() - kTail;
  const Bytes tail = file.Read(footer.offset, kTail);
  if (tail.size() != kTail || !EndsWithMagic(tail)) return std::nullopt;
  const RecordHead head = ParseHead(tail);
  if (head.op != kFooter || head.length != kFooterBody) return std::nullopt;
  ByteReader in(std::span<const std::byte>(tail).subspan(kRecordHead));
  footer.summary_start = in.Int<std::uint64_t>();
  in.Int<std::uint64_t>();  // where the offsets within the summary begin
  footer.crc = in.Int<std::uint32_t>();
  return footer;
}

/// Errors: RecordError unless the summary has the footer's checksum.
void CheckSummary(const RandomAccessFile& file, const Footer& footer) {
  if (footer.summary_start > footer.offset) throw RecordError("it begins behind the footer");
  if (footer.crc == 0) return;
  constexpr std::uint64_t kAtOnce = 1 << 20;
  const std::uint64_t end = footer.offset + kRecordHead + 8 + 8;
  std::uint32_t crc = 0;
  for (std::uint64_t at = footer.summary_start; at < end; at += kAtOnce)
    crc = Crc(file.Read(at, std::min(kAtOnce, end - at)), crc);
  if (crc != footer.crc) throw RecordError("wrong checksum");
}

class SummaryReader {
 public:
  explicit SummaryReader(const RandomAccessFile& file) : file_(file), window_(file) {}

  std::optional<Index> Read(const Footer& footer) {
    for (std::uint64_t at = footer.summary_start; at < footer.offset;) {
      const RecordHead head = ParseHead(window_.At(at, kRecordHead));
      at += kRecordHead;
      if (head.length > footer.offset - at) throw RecordError("a record ends early");
      Take(head, at);
      at += head.length;
    }
    if (!IsComplete()) return std::nullopt;
    std::sort(chunks_.begin(), chunks_.end(),
              [](const auto& a, const auto& b) { return a.offset < b.offset; });
    for (const ChunkIndexRecord& chunk : chunks_) AddBlock(chunk);
    const bool is_whole = all_counted_ ? count_ == statistics_->messages && AreAllDefined() : true;
    return is_whole ? std::optional(std::move(index_)) : std::nullopt;
  }

 private:
  void Take(const RecordHead& head, std::uint64_t at) {
    const bool is_wanted = head.op == kSchema || head.op == kChannel || head.op == kStatistics ||
                           head.op == kChunkIndex || head.op == kAttachmentIndex ||
                           head.op == kMetadataIndex;
    if (!is_wanted) return;
    if (head.length > kLargestRecord) throw RecordError("a record claims more than 256 MiB");
    const std::span<const std::byte> body = window_.At(at, head.length);
    if (head.op == kSchema || head.op == kChannel) {
      const std::string conflict = index_.definitions.Add(head.op, body);
      if (!conflict.empty())
        index_.problems.push_back({LogProblem::Kind::kOdd, file_.path(), conflict});
    } else if (head.op == kStatistics) {
      statistics_ = ParseStatistics(body);
    } else if (head.op == kChunkIndex) {
      chunks_.push_back(ParseChunkIndex(body));
    } else if (head.op == kAttachmentIndex) {
      index_.attachments.push_back(ParseAttachmentIndex(body));
    } else {
      index_.metadata.push_back(ParseMetadataIndex(body).offset);
    }
  }

  /// A summary may leave out what it likes; the counts tell.
  [[nodiscard]] bool IsComplete() {
    if (!statistics_ || statistics_->chunks != chunks_.size() ||
        statistics_->channels != index_.definitions.channels().size() || !HasAllSchemas() ||
        statistics_->attachments != index_.attachments.size() ||
        statistics_->metadata != index_.metadata.size())
      return false;
    const auto is_there = [&](std::uint64_t offset, Op op) {
      const auto bytes = window_.At(offset, 1);
      return !bytes.empty() && bytes[0] == static_cast<std::byte>(op);
    };
    return std::all_of(index_.attachments.begin(), index_.attachments.end(),
                       [&](const auto& a) { return is_there(a.offset, kAttachment); }) &&
           std::all_of(index_.metadata.begin(), index_.metadata.end(),
                       [&](std::uint64_t offset) { return is_there(offset, kMetadata); }) &&
           std::all_of(chunks_.begin(), chunks_.end(),
                       [](const auto& c) { return c.unpacked_size == 0 || c.index_length > 0; });
  }

  [[nodiscard]] bool HasAllSchemas() const {
    const Definitions& d = index_.definitions;
    return std::all_of(d.channels().begin(), d.channels().end(), [&](const auto& channel) {
      const std::uint16_t id = channel.second.schema_id;
      return id == 0 || d.schemas().contains(id);
    });
  }

  /// Errors: RecordError if the chunk lies beyond the file.
  void AddBlock(const ChunkIndexRecord& chunk) {
    const std::uint64_t rest = file_.Rest(chunk.offset);
    if (chunk.length > rest || chunk.index_length > rest - chunk.length)
      throw RecordError("a chunk lies beyond the end of the file");
    Block block{true, chunk.offset, chunk.length, chunk.unpacked_size, chunk.span, {}};
    if (const std::optional<ExtentCounter> counter = ReadMessageIndexes(chunk)) {
      if (counter->empty()) return;
      block.span = counter->span();
      block.channels = counter->extents();
      count_ += CountOf(*block.channels);
    } else {
      all_counted_ = false;
    }
    index_.blocks.push_back(std::move(block));
  }

  /// Nothing if they are damaged.
  std::optional<ExtentCounter> ReadMessageIndexes(const ChunkIndexRecord& chunk) {
    if (chunk.index_length > kLargestRecord) return std::nullopt;
    ExtentCounter counter;
    try {
      ForEachRecord(file_.Read(chunk.offset + chunk.length, chunk.index_length),
                    [&](std::uint8_t op, std::span<const std::byte> body) {
                      if (op != kMessageIndex) throw RecordError("no message index");
                      counter.Add(ParseMessageIndex(body));
                    });
    } catch (const RecordError&) {
      return std::nullopt;
    }
    return counter;
  }

  [[nodiscard]] bool AreAllDefined() const {
    const auto& known = index_.definitions.channels();
    return std::all_of(index_.blocks.begin(), index_.blocks.end(), [&](const Block& block) {
      return std::all_of(block.channels->begin(), block.channels->end(),
                         [&](const auto& extent) { return known.contains(extent.channel_id); });
    });
  }

  const RandomAccessFile& file_;
  FileWindow window_;
  Index index_;
  std::vector<ChunkIndexRecord> chunks_;
  std::optional<StatisticsRecord> statistics_;
  std::uint64_t count_ = 0;  // of messages that the chunks' indexes list
  bool all_counted_ = true;
};

}  // namespace

std::optional<Index> ReadSummary(const RandomAccessFile& file) {
  const std::optional<Footer> footer = ReadFooter(file);
  if (!footer || footer->summary_start == 0) return std::nullopt;
  CheckSummary(file, *footer);
  return SummaryReader(file).Read(*footer);
}

}  // namespace scoria::logs::mcap_format
