// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// MCAP files record by record, right or wrong, by the specification alone. Source: [MCAP].
namespace scoria::test {

/// Little endian.
[[nodiscard]] std::string Number(std::uint64_t value, int bytes);

/// As MCAP has it of a chunk's records.
[[nodiscard]] std::uint32_t Crc32(const std::string& bytes);

[[nodiscard]] std::string McapRecord(std::uint8_t op, const std::string& body);
[[nodiscard]] std::string McapSchema(int id, const std::string& name, const std::string& encoding,
                                     const std::string& text);
[[nodiscard]] std::string McapChannel(int id, int schema, const std::string& topic,
                                      const std::string& encoding);
[[nodiscard]] std::string McapMessage(int channel, std::uint64_t time_ns, const std::string& data);
[[nodiscard]] std::string McapMetadata(const std::string& name);
[[nodiscard]] std::string McapAttachment(const std::string& name, const std::string& data);

/// A chunk whose fields say what they please.
struct McapChunk {
  std::uint64_t first_ns = 0, last_ns = 0, unpacked_size = 0, packed_size = 0;
  std::uint32_t crc = 0;
  std::string compression, packed;
  [[nodiscard]] std::string ToRecord() const;
};
/// Uncompressed, without checksum, as it should be.
[[nodiscard]] McapChunk ToChunk(const std::string& records, std::uint64_t first_ns,
                                std::uint64_t last_ns);
/// By zstd or lz4.
[[nodiscard]] McapChunk ToPackedChunk(const std::string& records, std::uint64_t first_ns,
                                      std::uint64_t last_ns,
                                      const std::string& compression = "zstd");
/// (time, offset in the chunk) of each message.
[[nodiscard]] std::string McapMessageIndex(
    int channel, const std::vector<std::pair<std::uint64_t, std::uint64_t>>& messages);

/// Magic, header, the records, their end, `summary` behind a footer without checksum, magic.
[[nodiscard]] std::string McapFile(const std::string& records, const std::string& summary = "");

}  // namespace scoria::test
