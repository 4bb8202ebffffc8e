// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "logs/format/mcap_index.h"

namespace scoria::logs::mcap_format {
namespace {

constexpr std::uint64_t kLargestRun = 1 << 20;    // of messages that are in no chunk
constexpr std::uint64_t kLargestName = 64 << 10;  // of an attachment

/// Walks over the file's records. What belongs together is collected in one open block: a chunk and
/// the message indexes behind it, or a run of messages.
class Scanner {
 public:
  explicit Scanner(const RandomAccessFile& file) : file_(file), window_(file), at_(kMagic.size()) {}

  Index Scan() {
    while (Step()) {
    }
    CloseBlock();
    return std::move(index_);
  }

 private:
  /// What the message indexes of a chunk are.
  enum class Listing { kNone, kWhole, kDamaged };

  /// Takes one record. @returns false at the end of the data.
  bool Step() {
    const auto bytes = window_.At(at_, kRecordHead);
    const RecordHead head = bytes.size() == kRecordHead ? ParseHead(bytes) : RecordHead{};
    if (head.op == kDataEnd || head.op == kFooter) {
      TakeSummary();
      return false;
    }
    constexpr std::uint8_t kNoOp = 0;  // as in the zeros that a power cut may leave
    const bool is_whole = head.op != kNoOp && head.length <= file_.Rest(at_ + kRecordHead);
    if (!is_whole) {
      EndAtCut(head);
      return false;
    }
    try {
      Take(head);
    } catch (const RecordError& e) {
      Report(LogProblem::Kind::kLost, fmt::format("at byte {}: {}", at_, e.what()));
    }
    at_ += kRecordHead + head.length;
    return true;
  }

  void Take(const RecordHead& head) {
    switch (head.op) {
      case kSchema:
      case kChannel:
        Define(at_, head.op, Body(head));
        return;
      case kMessage:
        TakeMessage(head);
        return;
      case kChunk:
        OpenChunk(kRecordHead + head.length);
        return;
      case kMessageIndex:
        if (open_ && open_->is_chunk) TakeMessageIndex(head);
        return;
      case kAttachment:
        CloseBlock();
        if (const auto name = NameOfAttachment(Part(head, kLargestName)))
          index_.attachments.push_back({at_, *name});
        return;
      case kMetadata:
        CloseBlock();
        index_.metadata.push_back(at_);
        return;
      default:
        return;
    }
  }

  /// The first bytes of a record's body.
  std::span<const std::byte> Part(const RecordHead& head, std::uint64_t size) {
    return window_.At(at_ + kRecordHead, std::min(head.length, size));
  }
  std::span<const std::byte> Body(const RecordHead& head) {
    if (head.length > kLargestRecord) throw RecordError("a record claims more than 256 MiB");
    return Part(head, head.length);
  }

  void Define(std::uint64_t at, std::uint8_t op, std::span<const std::byte> body) {
    const std::string conflict = index_.definitions.Add(op, body);
    if (!conflict.empty())
      Report(LogProblem::Kind::kOdd, fmt::format("at byte {}: {}", at, conflict));
  }

  void TakeMessageIndex(const RecordHead& head) {
    try {
      counter_.Add(ParseMessageIndex(Body(head)));
      if (listing_ == Listing::kNone) listing_ = Listing::kWhole;
    } catch (const RecordError&) {  // the chunk itself tells
      listing_ = Listing::kDamaged;
    }
  }

  void TakeMessage(const RecordHead& head) {
    constexpr std::uint64_t kBeforeData = 2 + 4 + 8 + 8;
    const MessageRecord message = ParseMessage(Part(head, kBeforeData));
    const std::uint64_t length = kRecordHead + head.length;
    if (head.length > kLargestRecord) throw RecordError("a message claims more than 256 MiB");
    const bool goes_on = open_ && !open_->is_chunk && at_ + length - open_->offset <= kLargestRun;
    if (!goes_on) {
      CloseBlock();
      open_ = Block{false, at_, 0, 0, {}, {}};
    }
    open_->length = at_ + length - open_->offset;
    open_->unpacked_size = open_->length;
    counter_.Add(message);
  }

  void OpenChunk(std::uint64_t length) {
    constexpr std::uint64_t kBeforeRecords = 8 + 8 + 8 + 4 + 4 + 8, kLongestName = 64;
    CloseBlock();
    const ChunkRecord chunk = ParseChunk(window_.At(
        at_ + kRecordHead, std::min(length - kRecordHead, kBeforeRecords + kLongestName)));
    open_ = Block{true, at_, length, chunk.unpacked_size, chunk.span, {}};
  }

  /// Message indexes tell what is in a chunk; it is unpacked if it has none, or a channel that was
  /// not met before.
  void CloseBlock() {
    if (!open_) return;
    const bool is_known = counter_.IsWithin(index_.definitions);
    if (open_->is_chunk && !(listing_ == Listing::kWhole && is_known)) CountChunk();
    if (!counter_.empty()) {
      open_->span = counter_.span();
      open_->channels = counter_.extents();
      index_.blocks.push_back(*std::move(open_));
    }
    open_.reset();
    counter_ = {};
    listing_ = Listing::kNone;
  }

  /// Unpacks the open chunk, and counts and defines what is in it. Of one that is damaged it keeps
  /// what the message indexes list; reading it tells of the loss.
  void CountChunk() {
    const ExtentCounter listed = std::exchange(counter_, {});
    const LoadedBlock loaded = LoadBlock(file_, *open_);
    std::string problem = loaded.unpacked.problem;
    try {
      ForEachRecord(loaded.unpacked.records, [&](std::uint8_t op, auto body) {
        if (op == kMessage) counter_.Add(ParseMessage(body));
        if (op == kSchema || op == kChannel) Define(open_->offset, op, body);
      });
    } catch (const RecordError& e) {
      if (!loaded.unpacked.is_cut) problem = e.what();
    }
    if (problem.empty()) return;
    if (!listed.empty()) {
      counter_ = listed;
    } else {
      Report(LogProblem::Kind::kLost, fmt::format("at byte {}: {}", open_->offset, problem));
    }
  }

  /// The record at hand is not all there; of a chunk the first part is taken.
  void EndAtCut(const RecordHead& head) {
    try {
      if (head.op == kChunk) OpenChunk(file_.Rest(at_));
    } catch (const RecordError&) {  // not even the chunk's head is there
    }
    const bool in_chunk = open_ && open_->offset == at_;
    listing_ = Listing::kDamaged;  // the message indexes of the last chunk may be cut, too
    const std::size_t before = index_.blocks.size();
    CloseBlock();
    std::string rest;
    if (in_chunk && index_.blocks.size() > before)
      rest = fmt::format(", and {} messages of the chunk there",
                         CountOf(*index_.blocks.back().channels));
    Report(LogProblem::Kind::kCut,
           fmt::format("cut off at byte {}; everything before it was read{}", at_, rest));
  }

  /// Channels without messages may stand there alone. Other parts are not needed, nor whole.
  void TakeSummary() {
    CloseBlock();
    for (;;) {
      const auto bytes = window_.At(at_, kRecordHead);
      if (bytes.size() < kRecordHead) return;
      const RecordHead head = ParseHead(bytes);
      if (head.length > file_.Rest(at_ + kRecordHead)) return;
      try {
        if (head.op == kSchema || head.op == kChannel) Define(at_, head.op, Body(head));
      } catch (const RecordError&) {
        return;
      }
      at_ += kRecordHead + head.length;
    }
  }

  void Report(LogProblem::Kind kind, std::string what) {
    index_.problems.push_back({kind, file_.path(), std::move(what)});
  }

  const RandomAccessFile& file_;
  FileWindow window_;
  std::uint64_t at_;  // of the record at hand
  Index index_;
  std::optional<Block> open_;
  ExtentCounter counter_;             // of the open block
  Listing listing_ = Listing::kNone;  // of the open chunk
};

}  // namespace

Index ScanRecords(const RandomAccessFile& file) { return Scanner(file).Scan(); }

}  // namespace scoria::logs::mcap_format
