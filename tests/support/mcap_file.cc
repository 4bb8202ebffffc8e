// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mcap_file.h"

#include <lz4frame.h>
#include <zstd.h>

namespace scoria::test {
namespace {

const std::string kMagic("\x89MCAP0\r\n", 8);

std::string Text(const std::string& text) { return Number(text.size(), 4) + text; }

}  // namespace

std::string Number(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(i < 8 ? value >> (8 * i) : 0);
  return out;
}

/// Bit by bit, with the polynomial of IEEE 802.3.
std::uint32_t Crc32(const std::string& bytes) {
  constexpr std::uint32_t kPolynomial = 0xEDB88320;
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? kPolynomial : 0);
  }
  return ~crc;
}

std::string McapRecord(std::uint8_t op, const std::string& body) {
  return Number(op, 1) + Number(body.size(), 8) + body;
}

std::string McapSchema(int id, const std::string& name, const std::string& encoding,
                       const std::string& text) {
  return McapRecord(
      0x03, Number(static_cast<std::uint64_t>(id), 2) + Text(name) + Text(encoding) + Text(text));
}

std::string McapChannel(int id, int schema, const std::string& topic, const std::string& encoding) {
  return McapRecord(0x04, Number(static_cast<std::uint64_t>(id), 2) +
                              Number(static_cast<std::uint64_t>(schema), 2) + Text(topic) +
                              Text(encoding) + Number(0, 4));
}

std::string McapMessage(int channel, std::uint64_t time_ns, const std::string& data) {
  return McapRecord(0x05, Number(static_cast<std::uint64_t>(channel), 2) + Number(0, 4) +
                              Number(time_ns, 8) + Number(time_ns, 8) + data);
}

std::string McapMetadata(const std::string& name) {
  return McapRecord(0x0C, Text(name) + Number(0, 4));
}

std::string McapAttachment(const std::string& name, const std::string& data) {
  return McapRecord(
      0x09, Number(0, 16) + Text(name) + Text("") + Number(data.size(), 8) + data + Number(0, 4));
}

std::string McapChunk::ToRecord() const {
  return McapRecord(0x06, Number(first_ns, 8) + Number(last_ns, 8) + Number(unpacked_size, 8) +
                              Number(crc, 4) + Text(compression) + Number(packed_size, 8) + packed);
}

McapChunk ToChunk(const std::string& records, std::uint64_t first_ns, std::uint64_t last_ns) {
  return {first_ns, last_ns, records.size(), records.size(), 0, "", records};
}

McapChunk ToPackedChunk(const std::string& records, std::uint64_t first_ns, std::uint64_t last_ns,
                        const std::string& compression) {
  const bool is_zstd = compression == "zstd";
  const std::size_t most = is_zstd ? ZSTD_compressBound(records.size())
                                   : LZ4F_compressFrameBound(records.size(), nullptr);
  std::string packed(most, '\0');
  packed.resize(
      is_zstd ? ZSTD_compress(packed.data(), most, records.data(), records.size(), 1)
              : LZ4F_compressFrame(packed.data(), most, records.data(), records.size(), nullptr));
  return {first_ns, last_ns, records.size(), packed.size(), 0, compression, packed};
}

std::string McapMessageIndex(int channel,
                             const std::vector<std::pair<std::uint64_t, std::uint64_t>>& messages) {
  std::string entries;
  for (const auto& [time_ns, offset] : messages) entries += Number(time_ns, 8) + Number(offset, 8);
  return McapRecord(0x07, Number(static_cast<std::uint64_t>(channel), 2) + Text(entries));
}

std::string McapFile(const std::string& records, const std::string& summary) {
  const std::string data =
      kMagic + McapRecord(0x01, Text("") + Text("")) + records + McapRecord(0x0F, Number(0, 4));
  const std::string footer =
      Number(summary.empty() ? 0 : data.size(), 8) + Number(0, 8) + Number(0, 4);
  return data + summary + McapRecord(0x02, footer) + kMagic;
}

}  // namespace scoria::test
