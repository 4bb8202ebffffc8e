// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/bag_log.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "logs/format/problem_list.h"

namespace scoria::logs {
namespace {

void Include(std::optional<LogSpan>& span, const std::optional<LogSpan>& other) {
  if (!other) return;
  if (!span) span = other;
  span->first_ns = std::min(span->first_ns, other->first_ns);
  span->last_ns = std::max(span->last_ns, other->last_ns);
}

/// One file and which channels of the bag its own are.
struct Part {
  std::unique_ptr<LogSource> log;
  std::vector<std::size_t> channels;
  std::size_t problems_taken = 0;
  [[nodiscard]] std::int64_t first_ns() const {
    const auto& span = log->contents().span;
    return span ? span->first_ns : std::numeric_limits<std::int64_t>::max();
  }
  void TakeProblems(ProblemList& into) {
    for (; problems_taken < log->problems().size(); ++problems_taken)
      into.Add(log->problems()[problems_taken]);
  }
};

/// Reads the files that overlap in time together, in the order of time, and else one by one.
class BagCursor final : public LogCursor {
 public:
  BagCursor(std::vector<Part>& parts, const LogContents& contents, ProblemList& problems,
            LogFilter filter)
      : parts_(parts), contents_(contents), problems_(problems), filter_(std::move(filter)) {
    by_time_ = filter_.order == LogOrder::kTime && contents_.can_order_by_time;
  }

  std::optional<LogMessage> Next() override {
    if (front_ != kNone) Advance(front_);
    while (next_part_ < parts_.size() &&
           (open_.empty() || (by_time_ && parts_[next_part_].first_ns() < FrontTime())))
      Open(parts_[next_part_++]);
    front_ = Front();
    if (front_ == kNone) return std::nullopt;
    const LogMessage& m = *open_[front_]->message;
    const std::size_t channel = open_[front_]->part.channels[m.channel_index];
    return LogMessage{
        channel, contents_.channels[channel], m.log_time_ns, m.publish_time_ns, m.sequence, m.data};
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct OpenPart {
    Part& part;
    std::unique_ptr<LogCursor> cursor;
    std::optional<LogMessage> message;
  };

  void Open(Part& part) {
    if (part.log->contents().span && !filter_.Meets(*part.log->contents().span)) return;
    open_.push_back(
        std::make_unique<OpenPart>(OpenPart{part, part.log->Read(filter_), std::nullopt}));
    Advance(open_.size() - 1);
  }

  void Advance(std::size_t at) {
    OpenPart& open = *open_[at];
    const std::optional<LogMessage> next = open.cursor->Next();
    open.message.reset();
    if (next) open.message.emplace(*next);
    open.part.TakeProblems(problems_);
    if (!next) open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  /// The open part whose message is earliest; of equal times the earlier part's.
  [[nodiscard]] std::size_t Front() const {
    std::size_t front = open_.empty() ? kNone : 0;
    for (std::size_t i = 1; i < open_.size(); ++i) {
      if (open_[i]->message->log_time_ns < open_[front]->message->log_time_ns) front = i;
    }
    return front;
  }
  [[nodiscard]] std::int64_t FrontTime() const { return open_[Front()]->message->log_time_ns; }

  std::vector<Part>& parts_;
  const LogContents& contents_;
  ProblemList& problems_;
  LogFilter filter_;
  bool by_time_ = true;
  std::size_t next_part_ = 0;
  std::vector<std::unique_ptr<OpenPart>> open_;  // each with a message, in the order of parts
  std::size_t front_ = kNone;                    // whose message was given out
};

class BagLog final : public LogSource {
 public:
  BagLog(const std::filesystem::path& path, const BagFiles& bag,
         std::vector<std::unique_ptr<LogSource>> logs) {
    for (const LogProblem& problem : bag.problems) problems_.Add(problem);
    for (std::unique_ptr<LogSource>& log : logs) parts_.push_back({std::move(log), {}, 0});
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.first_ns() < b.first_ns(); });
    contents_.path = path;
    contents_.format = parts_.front().log->contents().format;
    if (parts_.size() > 1) contents_.format += fmt::format(" in {} files", parts_.size());
    for (Part& part : parts_) Add(part);
    if (!bag.metadata) return;
    for (const std::string& difference : CompareMetadata(*bag.metadata, contents_))
      problems_.Add({LogProblem::Kind::kOdd, bag.metadata_file, difference});
  }

  [[nodiscard]] const LogContents& contents() const override { return contents_; }
  [[nodiscard]] const std::vector<LogProblem>& problems() const override {
    return problems_.problems();
  }
  [[nodiscard]] std::unique_ptr<LogCursor> Read(const LogFilter& filter) override {
    return std::make_unique<BagCursor>(parts_, contents_, problems_, filter);
  }
  [[nodiscard]] std::optional<LogAttachment> ReadAttachment(const std::string& name) override {
    for (Part& part : parts_) {
      if (std::optional<LogAttachment> found = part.log->ReadAttachment(name)) return found;
    }
    return std::nullopt;
  }

 private:
  void Add(Part& part) {
    const LogContents& contents = part.log->contents();
    for (const LogChannel& channel : contents.channels)
      part.channels.push_back(AddChannel(channel, part.channels));
    Include(contents_.span, contents.span);
    contents_.can_order_by_time = contents_.can_order_by_time && contents.can_order_by_time;
    for (const auto& [name, entries] : contents.metadata) contents_.metadata[name] = entries;
    for (const std::string& name : contents.attachments) contents_.attachments.push_back(name);
    part.TakeProblems(problems_);
  }

  /// @param taken  channels of the bag that the same file has already: two of a file stay two.
  std::size_t AddChannel(const LogChannel& channel, const std::vector<std::size_t>& taken) {
    for (std::size_t i = 0; i < contents_.channels.size(); ++i) {
      LogChannel& known = contents_.channels[i];
      const bool is_same = known.topic == channel.topic && known.type_name == channel.type_name &&
                           known.schema == channel.schema &&
                           known.message_encoding == channel.message_encoding &&
                           std::find(taken.begin(), taken.end(), i) == taken.end();
      if (!is_same) continue;
      if (known.message_count && channel.message_count) {
        *known.message_count += *channel.message_count;
      } else {
        known.message_count.reset();
      }
      Include(known.span, channel.span);
      return i;
    }
    contents_.channels.push_back(channel);
    return contents_.channels.size() - 1;
  }

  std::vector<Part> parts_;  // by their first messages
  LogContents contents_;
  ProblemList problems_;
};

}  // namespace

std::unique_ptr<LogSource> JoinBag(const std::filesystem::path& path, const BagFiles& bag,
                                   std::vector<std::unique_ptr<LogSource>> parts) {
  return std::make_unique<BagLog>(path, bag, std::move(parts));
}

}  // namespace scoria::logs
