// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "logs/format/cdr.h"
#include "logs/format/csv_log.h"
#include "logs/format/log_source.h"

namespace scoria::test {

/// A log that a test makes up, message by message, read in the order in which they were added.
class MemoryLog final : public logs::LogSource {
 public:
  MemoryLog() {
    contents_.path = "memory";
    contents_.format = "a log in memory";
  }

  /// A channel of CDR messages; without a definition, as bags of old have them, unless a text of
  /// ros2msg is given.
  std::size_t AddChannel(const std::string& topic, const std::string& type,
                         const std::string& definition = "") {
    logs::LogChannel& channel = contents_.channels.emplace_back();
    channel.topic = topic;
    channel.type_name = type;
    channel.message_encoding = "cdr";
    if (!definition.empty()) channel.schema = {"ros2msg", definition};
    return contents_.channels.size() - 1;
  }
  void AddTable(const std::string& topic, const logs::CsvDialect& dialect) {
    contents_.channels.push_back(logs::MakeCsvChannel(topic, dialect));
  }
  void AddMetadata(const std::string& name, const logs::LogMetadata& metadata) {
    contents_.metadata[name] = metadata;
  }
  void Add(std::size_t channel, std::int64_t time_ns, logs::Bytes bytes) {
    messages_.push_back({channel, time_ns, std::move(bytes)});
  }
  template <class Message>
  void AddMessage(std::size_t channel, std::int64_t time_ns, Message message) {
    logs::Bytes bytes;
    logs::EncodeCdr(message, bytes);
    Add(channel, time_ns, std::move(bytes));
  }

  [[nodiscard]] const logs::LogContents& contents() const override { return contents_; }
  [[nodiscard]] const std::vector<logs::LogProblem>& problems() const override { return none_; }
  [[nodiscard]] std::unique_ptr<logs::LogCursor> Read(const logs::LogFilter& filter) override {
    return std::make_unique<Cursor>(*this, filter);
  }
  [[nodiscard]] std::optional<logs::LogAttachment> ReadAttachment(const std::string&) override {
    return std::nullopt;
  }

 private:
  struct Stored {
    std::size_t channel;
    std::int64_t time_ns;
    logs::Bytes bytes;
  };
  class Cursor final : public logs::LogCursor {
   public:
    Cursor(const MemoryLog& log, logs::LogFilter filter) : log_(log), filter_(std::move(filter)) {}
    [[nodiscard]] std::optional<logs::LogMessage> Next() override {
      while (next_ < log_.messages_.size()) {
        const Stored& m = log_.messages_[next_++];
        const logs::LogChannel& channel = log_.contents_.channels[m.channel];
        if (filter_.HasTopic(channel.topic))
          return logs::LogMessage{m.channel,    channel,      m.time_ns,
                                  std::nullopt, std::nullopt, m.bytes};
      }
      return std::nullopt;
    }

   private:
    const MemoryLog& log_;
    logs::LogFilter filter_;
    std::size_t next_ = 0;
  };

  logs::LogContents contents_;
  std::vector<Stored> messages_;
  std::vector<logs::LogProblem> none_;
};

}  // namespace scoria::test
