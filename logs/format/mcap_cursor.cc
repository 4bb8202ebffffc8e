// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_cursor.h"

#include <algorithm>

#include <fmt/format.h>

namespace scoria::logs::mcap_format {

McapCursor::McapCursor(const McapView& view, LogFilter filter)
    : view_(view),
      filter_(std::move(filter)),
      by_time_(filter_.order == LogOrder::kTime && view.contents.can_order_by_time) {
  for (const LogChannel& channel : view_.contents.channels)
    wanted_.push_back(filter_.HasTopic(channel.topic));
  for (const Block& block : view_.index.blocks) {
    if (MayHoldWanted(block)) blocks_.push_back(&block);
  }
  if (by_time_) {
    std::stable_sort(blocks_.begin(), blocks_.end(), [](const Block* a, const Block* b) {
      return a->span.first_ns < b->span.first_ns;
    });
  }
}

std::optional<LogMessage> McapCursor::Next() {
  for (;;) {
    if (delivered_) AdvanceFront();
    delivered_ = false;
    while (next_block_ < blocks_.size() &&
           (open_.empty() ||
            (by_time_ && blocks_[next_block_]->span.first_ns <= open_.front()->time_ns()))) {
      OpenBlockOf(*blocks_[next_block_++]);
    }
    if (open_.empty()) return std::nullopt;
    const OpenBlock& front = *open_.front();
    const MessageRecord message = ParseMessage(front.places[front.next].body);
    const std::size_t index = view_.channel_indexes.at(message.channel_id);
    const LogChannel& channel = view_.contents.channels[index];
    delivered_ = true;
    if (const auto data = unpacker_.Unpack(message.data))
      return LogMessage{
          index, channel, message.log_time_ns, message.publish_time_ns, message.sequence, *data};
    Report(LogProblem::Kind::kLost,
           fmt::format("messages of {} are lost: they do not decompress", channel.topic));
  }
}

bool McapCursor::IsLater(const std::unique_ptr<OpenBlock>& a, const std::unique_ptr<OpenBlock>& b) {
  return std::pair(a->time_ns(), a->offset) > std::pair(b->time_ns(), b->offset);
}

void McapCursor::AdvanceFront() {
  std::pop_heap(open_.begin(), open_.end(), IsLater);
  if (++open_.back()->next == open_.back()->places.size()) {
    open_.pop_back();
  } else {
    std::push_heap(open_.begin(), open_.end(), IsLater);
  }
}

void McapCursor::OpenBlockOf(const Block& block) {
  auto open = std::make_unique<OpenBlock>();
  open->offset = block.offset;
  open->loaded = LoadBlock(view_.file, block);
  const UnpackedChunk& unpacked = open->loaded.unpacked;
  std::string problem = unpacked.problem;
  std::uint64_t count = 0;
  bool in_span = true;
  try {
    ForEachRecord(unpacked.records, [&](std::uint8_t op, std::span<const std::byte> body) {
      if (op == kSchema || op == kChannel)
        Report(LogProblem::Kind::kOdd, view_.index.definitions.Conflict(op, body));
      if (op != kMessage) return;
      const MessageRecord message = ParseMessage(body);
      ++count;
      in_span = in_span && message.log_time_ns >= block.span.first_ns &&
                message.log_time_ns <= block.span.last_ns;
      if (IsWanted(message)) open->places.push_back({message.log_time_ns, body});
    });
  } catch (const RecordError& e) {
    if (!unpacked.is_cut) problem = e.what();
  }
  if (!problem.empty()) {
    ReportLoss(block, problem);
  } else if (!in_span || (block.channels && CountOf(*block.channels) != count)) {
    Report(
        LogProblem::Kind::kOdd,
        fmt::format("at byte {}: the chunk's index is wrong about its {} messages or their times, "
                    "so they may come out of their order",
                    block.offset, count));
  }
  if (open->places.empty()) return;
  const auto is_earlier = [](const Place& a, const Place& b) { return a.time_ns < b.time_ns; };
  if (by_time_ && !std::is_sorted(open->places.begin(), open->places.end(), is_earlier))
    std::stable_sort(open->places.begin(), open->places.end(), is_earlier);
  open_.push_back(std::move(open));
  std::push_heap(open_.begin(), open_.end(), IsLater);
}

bool McapCursor::MayHoldWanted(const Block& block) const {
  if (!filter_.Meets(block.span)) return false;
  return !block.channels ||
         std::any_of(block.channels->begin(), block.channels->end(), [&](const auto& extent) {
           const auto channel = view_.channel_indexes.find(extent.channel_id);
           return channel == view_.channel_indexes.end() || wanted_[channel->second];
         });
}

bool McapCursor::IsWanted(const MessageRecord& message) {
  const auto channel = view_.channel_indexes.find(message.channel_id);
  if (channel == view_.channel_indexes.end()) {
    Report(LogProblem::Kind::kLost,
           fmt::format("messages of channel {} are lost: the file does not define it",
                       message.channel_id));
    return false;
  }
  return wanted_[channel->second] && message.log_time_ns >= filter_.from_ns &&
         message.log_time_ns <= filter_.to_ns;
}

void McapCursor::Report(LogProblem::Kind kind, const std::string& what) {
  if (!what.empty()) view_.problems.Add({kind, view_.file.path(), what});
}

void McapCursor::ReportLoss(const Block& block, const std::string& what) {
  constexpr double kS = 1e-9;
  const std::int64_t start_ns = view_.contents.span->first_ns;
  Report(LogProblem::Kind::kLost,
         fmt::format("at byte {}: {}; {} messages are lost, {:.3f} s to {:.3f} s after the log's "
                     "first",
                     block.offset, what,
                     block.channels ? fmt::to_string(CountOf(*block.channels)) : "its",
                     kS * static_cast<double>(block.span.first_ns - start_ns),
                     kS * static_cast<double>(block.span.last_ns - start_ns)));
}

}  // namespace scoria::logs::mcap_format
