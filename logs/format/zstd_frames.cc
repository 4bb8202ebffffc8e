// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/zstd_frames.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <zstd.h>

#include "core/files.h"

namespace scoria::logs {
namespace {

/// Where unpacked bytes go.
class Output {
 public:
  Output(const RandomAccessFile& packed, std::filesystem::path path, std::uint64_t most)
      : packed_(packed), path_(std::move(path)), most_(most), file_(path_, std::ios::binary) {
    Check();
  }
  [[nodiscard]] std::uint64_t written() const { return written_; }
  void Write(std::span<const std::byte> bytes) {
    written_ += bytes.size();
    DemandAtMost(written_);
    file_.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
    Check();
  }
  void DemandAtMost(std::uint64_t bytes) const {
    if (bytes > most_)
      throw std::runtime_error(fmt::format("{}: {} bytes unpack to more than {}: this is no log",
                                           packed_.path().string(), packed_.size(), most_));
  }
  void Close() {
    file_.close();
    Check();
  }

 private:
  void Check() const {
    if (!file_) throw core::FileError(path_, "cannot write", errno);
  }
  const RandomAccessFile& packed_;
  std::filesystem::path path_;
  std::uint64_t most_;
  std::ofstream file_;
  std::uint64_t written_ = 0;
};

}  // namespace

bool IsZstd(std::span<const std::byte> bytes) {
  constexpr unsigned char kFrame[] = {0x28, 0xB5, 0x2F, 0xFD};  // RFC 8878
  return bytes.size() >= sizeof kFrame &&
         std::ranges::equal(bytes.first(sizeof kFrame), std::as_bytes(std::span(kFrame)));
}

std::uint64_t LargestUnpackedLog(std::uint64_t packed_size) {
  constexpr std::uint64_t kAlways = std::uint64_t{1} << 30, kRatio = 200;
  return std::max(kAlways, kRatio * packed_size);
}

std::string UnpackZstd(const RandomAccessFile& packed, const std::filesystem::path& out,
                       std::uint64_t most) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     &ZSTD_freeDCtx);
  Output output(packed, out, most);
  const Bytes head = packed.Read(0, ZSTD_DStreamInSize());
  const unsigned long long claimed = ZSTD_getFrameContentSize(head.data(), head.size());
  if (claimed != ZSTD_CONTENTSIZE_UNKNOWN && claimed != ZSTD_CONTENTSIZE_ERROR)
    output.DemandAtMost(claimed);
  Bytes piece(ZSTD_DStreamOutSize());
  std::size_t left = 0;  // of the frame at hand
  for (std::uint64_t at = 0; at < packed.size();) {
    const Bytes bytes = packed.Read(at, ZSTD_DStreamInSize());
    if (bytes.empty()) break;
    ZSTD_inBuffer from{bytes.data(), bytes.size(), 0};
    for (bool has_more = true; from.pos < from.size || has_more;) {
      ZSTD_outBuffer to{piece.data(), piece.size(), 0};
      left = ZSTD_decompressStream(context.get(), &to, &from);
      if (ZSTD_isError(left) != 0)
        return fmt::format("does not decompress behind byte {} ({}); {} bytes came out",
                           at + from.pos, ZSTD_getErrorName(left), output.written());
      output.Write(std::span<const std::byte>(piece).first(to.pos));
      has_more = to.pos == to.size && left != 0;
    }
    at += bytes.size();
  }
  output.Close();
  return left == 0 ? "" : fmt::format("its zstd frame is cut; {} bytes came out", output.written());
}

MessageUnpacker::MessageUnpacker() = default;
MessageUnpacker::~MessageUnpacker() = default;
void MessageUnpacker::FreeContext::operator()(ZSTD_DCtx_s* context) const {
  ZSTD_freeDCtx(context);
}

std::optional<std::span<const std::byte>> MessageUnpacker::Unpack(std::span<const std::byte> data) {
  if (!IsZstd(data)) return data;
  constexpr std::size_t kLargest = std::size_t{1} << 28, kFirst = 4096;
  if (context_ == nullptr) context_.reset(ZSTD_createDCtx());
  ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only);
  ZSTD_inBuffer from{data.data(), data.size(), 0};
  std::size_t done = 0;
  for (;;) {
    // The frame may say its size, but nothing is believed: what is there comes out.
    if (done == unpacked_.size()) unpacked_.resize(std::max(kFirst, 2 * unpacked_.size()));
    if (done >= kLargest) return std::nullopt;
    ZSTD_outBuffer to{unpacked_.data(), unpacked_.size(), done};
    const std::size_t left = ZSTD_decompressStream(context_.get(), &to, &from);
    if (ZSTD_isError(left) != 0) return std::nullopt;
    const bool is_stuck = to.pos == done && from.pos == from.size && left != 0;
    done = to.pos;
    if (left == 0 && from.pos == from.size) break;
    if (is_stuck) return std::nullopt;
  }
  return std::span<const std::byte>(unpacked_).first(done);
}

}  // namespace scoria::logs
