// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::logs {

/// How chunks are packed.
enum class McapCompression { kZstd, kLz4, kNone };

/// Writes an MCAP file of the `ros2` profile: CDR messages under ros2msg schemas in chunks
/// with index. Every chunk is flushed when it is full, so a killed process loses at most the last
/// one. Source: [MCAP] specification, version 0.
class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1 << 20;
  static constexpr const char* kRosProfile = "ros2";

  /// @param profile  of what the channels hold; empty: none.
  /// Errors, here and below: core::FileError if the file cannot be opened or written.
  explicit McapWriter(const std::filesystem::path& path, std::size_t chunk_bytes = kChunkBytes,
                      McapCompression compression = McapCompression::kZstd,
                      const std::string& profile = kRosProfile);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// @returns the channel's number, to write messages to. Channels of the same type and schema
  /// share it. One without messages is not in the file.
  std::uint16_t AddChannel(const std::string& topic, const std::string& type_name,
                           const std::string& schema_text);
  void Write(std::uint16_t channel, std::int64_t time_ns, std::span<const std::byte> message);

  /// A channel of another log, in the file whether it has messages or not.
  /// Errors: std::runtime_error for more channels than the format can number.
  std::uint16_t CopyChannel(const LogChannel& channel);
  /// With its times and its sequence number; the container's own where the message has none.
  void Copy(std::uint16_t channel, const LogMessage& message);

  void AddMetadata(const std::string& name, const LogMetadata& metadata);
  void AddAttachment(const LogAttachment& attachment);

  /// Writes the index and ends the file; called by the destructor, where errors are lost.
  void Close();

 private:
  struct Channel {
    std::uint16_t schema = 0;  // 0: none
    std::string topic, message_encoding;
    LogMetadata metadata;
    std::uint32_t sequence = 0;
    bool announced = false;  // in the file
    bool is_kept = false;    // without messages, too
    std::uint64_t count = 0;
  };
  struct Schema {
    std::string name;
    LogSchema schema;
    bool announced = false;
  };
  struct MessageHead {
    std::uint32_t sequence = 0;
    std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  };
  struct ChunkIndex {
    std::uint64_t first_ns, last_ns, offset, length, index_length, compressed, uncompressed;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
  };
  struct MetadataIndex {
    std::uint64_t offset, length;
    std::string name;
  };
  struct AttachmentIndex {
    std::uint64_t offset, length, data_size;
    std::string name, media_type;
  };

  void Emit(const Bytes& bytes);
  std::uint16_t Add(Channel channel, const std::string& type_name,
                    const std::optional<LogSchema>& schema);
  void Announce(std::uint16_t number, Bytes& out);
  void Append(std::uint16_t number, const MessageHead& head, std::span<const std::byte> message);
  void FlushChunk();
  void AppendSchema(Bytes& out, std::size_t index) const;
  void AppendChannel(Bytes& out, std::size_t index) const;
  [[nodiscard]] Bytes SchemaRecords() const;
  [[nodiscard]] Bytes ChannelRecords() const;
  [[nodiscard]] Bytes StatisticsRecord() const;
  [[nodiscard]] Bytes ChunkIndexRecords() const;
  [[nodiscard]] Bytes AttachmentIndexRecords() const;
  [[nodiscard]] Bytes MetadataIndexRecords() const;
  void WriteSummary();

  std::ofstream out_;
  std::string path_;
  std::size_t chunk_bytes_;
  McapCompression compression_;
  std::uint64_t offset_ = 0;
  Bytes chunk_;
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0, first_ns_ = 0, last_ns_ = 0, total_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;
  std::vector<Schema> schemas_;    // number = index + 1
  std::vector<Channel> channels_;  // number = index
  std::vector<ChunkIndex> chunk_indexes_;
  std::vector<MetadataIndex> metadata_indexes_;
  std::vector<AttachmentIndex> attachment_indexes_;
  bool closed_ = false;
};

}  // namespace scoria::logs
