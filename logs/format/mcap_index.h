// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/mcap_chunk.h"
#include "logs/format/random_access_file.h"

/// Where the things of an MCAP file are, for reading them in any order.
namespace scoria::logs::mcap_format {

/// No record that has to be held in memory whole is larger, but for attachments.
inline constexpr std::uint64_t kLargestRecord = std::uint64_t{1} << 28;

/// Schemas and channels by their numbers; of two definitions of a number the first counts.
class Definitions {
 public:
  /// Takes a schema or channel record. @returns as Conflict.
  std::string Add(std::uint8_t op, std::span<const std::byte> body);
  /// @returns in what the record differs from a definition, empty if in nothing.
  [[nodiscard]] std::string Conflict(std::uint8_t op, std::span<const std::byte> body) const;

  [[nodiscard]] const std::map<std::uint16_t, SchemaRecord>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, ChannelRecord>& channels() const { return channels_; }

 private:
  std::map<std::uint16_t, SchemaRecord> schemas_;
  std::map<std::uint16_t, ChannelRecord> channels_;
};

/// A stretch of the file that holds messages: a chunk, or messages that are in no chunk.
struct Block {
  bool is_chunk = true;
  std::uint64_t offset = 0, length = 0;  // of the chunk's record, or of all records
  std::uint64_t unpacked_size = 0;
  LogSpan span;
  std::optional<std::vector<ChannelExtent>> channels;  // none: unknown, maybe all
};

struct Index {
  Definitions definitions;
  std::vector<Block> blocks;  // in the order of the file; only such as have messages
  std::vector<RecordPlace> attachments;
  std::vector<std::uint64_t> metadata;  // offsets of the records
  std::vector<LogProblem> problems;
};

/// From the file's summary if that is whole and complete, else from all its records; of chunks with
/// message indexes those alone are read.
/// Errors: core::FileError.
[[nodiscard]] Index ReadIndex(const RandomAccessFile& file);

/// The index that the file's summary holds. @returns nothing if the file has none or a part of it.
/// Errors: RecordError if it is damaged; core::FileError.
[[nodiscard]] std::optional<Index> ReadSummary(const RandomAccessFile& file);

/// The index as found by walking over the file from its beginning to where its data end or it is
/// cut. Errors: core::FileError.
[[nodiscard]] Index ScanRecords(const RandomAccessFile& file);

/// All messages of the channels.
[[nodiscard]] std::uint64_t CountOf(const std::vector<ChannelExtent>& channels);

/// Counts messages by channel.
class ExtentCounter {
 public:
  void Add(const ChannelExtent& extent);
  void Add(const MessageRecord& m) { Add({m.channel_id, 1, {m.log_time_ns, m.log_time_ns}}); }
  [[nodiscard]] bool empty() const { return extents_.empty(); }
  [[nodiscard]] bool IsWithin(const Definitions& definitions) const;
  /// @pre not empty
  [[nodiscard]] LogSpan span() const;
  [[nodiscard]] std::vector<ChannelExtent> extents() const;

 private:
  std::map<std::uint16_t, ChannelExtent> extents_;  // without those of no message
};

/// The records of a block in memory.
struct LoadedBlock {
  Bytes raw;  // as the file has it
  UnpackedChunk unpacked;
};
[[nodiscard]] LoadedBlock LoadBlock(const RandomAccessFile& file, const Block& block);

/// Calls visit(opcode, body) for each of the records. Errors: RecordError where they end early.
template <class Visit>
void ForEachRecord(std::span<const std::byte> records, const Visit& visit) {
  for (ByteReader in(records); !in.empty();) {
    const auto op = in.Int<std::uint8_t>();
    visit(op, in.Raw(in.Int<std::uint64_t>()));
  }
}

}  // namespace scoria::logs::mcap_format
