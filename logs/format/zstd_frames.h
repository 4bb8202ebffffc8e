// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "logs/format/bytes.h"
#include "logs/format/random_access_file.h"

struct ZSTD_DCtx_s;

/// Files and messages that rosbag2 compressed by zstd, each by itself. Source: [Collet2021].
namespace scoria::logs {

/// Whether bytes begin as a zstd frame does.
[[nodiscard]] bool IsZstd(std::span<const std::byte> bytes);

/// How much a packed log may unpack to: no log comes near. Sensor data pack to a half or a tenth.
[[nodiscard]] std::uint64_t LargestUnpackedLog(std::uint64_t packed_size);

/// Unpacks a file of zstd frames, with or without a content size, into another file, piece by
/// piece. @returns what is wrong, empty if nothing; what could be unpacked before that is there.
/// Errors: core::FileError if the operating system refuses; std::runtime_error if there is more
/// than `most` bytes.
[[nodiscard]] std::string UnpackZstd(const RandomAccessFile& packed,
                                     const std::filesystem::path& out, std::uint64_t most);

/// Unpacks messages one after the other.
class MessageUnpacker {
 public:
  MessageUnpacker();
  ~MessageUnpacker();

  /// The message as it was sent: `data` itself unless that is a zstd frame; until the next call.
  /// Nothing where a frame is damaged, or claims more than 256 MiB.
  [[nodiscard]] std::optional<std::span<const std::byte>> Unpack(std::span<const std::byte> data);

 private:
  struct FreeContext {
    void operator()(ZSTD_DCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_DCtx_s, FreeContext> context_;  // created by the first frame
  Bytes unpacked_;
};

}  // namespace scoria::logs
