// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "logs/format/mcap_index.h"
#include "logs/format/problem_list.h"
#include "logs/format/zstd_frames.h"

namespace scoria::logs::mcap_format {

/// What a cursor reads from; all borrowed.
struct McapView {
  const RandomAccessFile& file;
  const Index& index;
  const LogContents& contents;
  const std::unordered_map<std::uint16_t, std::size_t>& channel_indexes;  // by MCAP's number
  ProblemList& problems;
};

/// Goes through the blocks that hold what the filter wants. In the order of time, blocks that
/// overlap are in memory together; as stored, one after the other.
class McapCursor final : public LogCursor {
 public:
  McapCursor(const McapView& view, LogFilter filter);
  std::optional<LogMessage> Next() override;

 private:
  struct Place {
    std::int64_t time_ns = 0;
    std::span<const std::byte> body;  // of the message's record
  };
  /// A block in memory and how far it was read.
  struct OpenBlock {
    std::uint64_t offset = 0;  // in the file
    LoadedBlock loaded;
    std::vector<Place> places;  // of the messages that are wanted, in the order of reading
    std::size_t next = 0;
    [[nodiscard]] std::int64_t time_ns() const { return places[next].time_ns; }
  };
  /// By time, equal times as stored.
  static bool IsLater(const std::unique_ptr<OpenBlock>& a, const std::unique_ptr<OpenBlock>& b);

  void AdvanceFront();
  void OpenBlockOf(const Block& block);
  [[nodiscard]] bool MayHoldWanted(const Block& block) const;
  [[nodiscard]] bool IsWanted(const MessageRecord& message);
  void Report(LogProblem::Kind kind, const std::string& what);
  void ReportLoss(const Block& block, const std::string& what);

  McapView view_;
  LogFilter filter_;
  bool by_time_;
  std::vector<bool> wanted_;          // by channel
  std::vector<const Block*> blocks_;  // in the order of reading
  std::size_t next_block_ = 0;
  std::vector<std::unique_ptr<OpenBlock>> open_;  // a heap; the front comes next
  bool delivered_ = false;                        // the front's message
  MessageUnpacker unpacker_;
};

}  // namespace scoria::logs::mcap_format
