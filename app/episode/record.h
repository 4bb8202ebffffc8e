// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/episode/observer.h"
#include "app/scenario/scenario.h"
#include "controller/controller.h"
#include "logs/format/mcap_writer.h"
#include "logs/messages/scoria.h"

namespace scoria::app {

/// A topic of the log: what it holds and how to list a message's fields.
struct Topic {
  std::string name, type_name, schema_text;
  bool reproducible = true;   // false where messages hold wall-clock times
  bool of_reference = false;  // the reference framework's recorder writes it
  std::vector<std::pair<std::string, std::string>> (*list_fields)(std::span<const std::byte>) =
      nullptr;
};

/// Where the recorder's messages go.
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  virtual void Write(const Topic& topic, std::int64_t time_ns,
                     std::span<const std::byte> message) = 0;
  /// Something happened that a log keeping only falls must show.
  virtual void MarkFall(std::int64_t time_ns) = 0;
};

/// Turns steps into the log's messages: the reference framework's topics and ours.
class Recorder final : public EpisodeObserver {
 public:
  /// `sink` is borrowed.
  Recorder(MessageSink& sink, const Scenario& scenario);
  void OnStart(double time_s, const controller::Start& start) override;
  void OnRow(const StepRecord& record, const logs::Row& row) override;
  void OnStep(const StepRecord& record) override;
  void OnEvent(const EpisodeEvent& event) override;
  [[nodiscard]] bool wants_rows() const override { return true; }

 private:
  template <class Message>
  void Write(const Topic& topic, double time_s, Message message);
  void RecordSensors(const StepRecord& record);
  void RecordBody(const StepRecord& record);
  void RecordPlans(const StepRecord& record);
  void RecordSlow(const StepRecord& record);

  MessageSink& sink_;
  int slow_every_;  // steps between messages of the slow topics
  logs::Bytes buffer_;
};

/// Every topic that Recorder writes.
[[nodiscard]] const std::vector<Topic>& RecordedTopics();

/// Whether a log of these parameters has messages of a topic.
[[nodiscard]] bool IsLogged(const Topic& topic, const LogParams& params);

/// What a log lacks by its parameters, as "the log holds the reference's topics alone
/// (log.topics=reference)"; empty if it has all topics.
[[nodiscard]] std::string MissingTopics(const LogParams& params);

/// Writes an MCAP log that can be re-run and drawn on another computer: effective scenario, URDF,
/// mesh boxes, heightmap, versions, terrain statistics.
class FileSink final : public MessageSink {
 public:
  FileSink(const std::filesystem::path& path, const Scenario& scenario,
           const core::RobotDescription& robot, const logs::LogMetadata& extra);
  void Write(const Topic& topic, std::int64_t time_ns, std::span<const std::byte> message) override;
  void MarkFall(std::int64_t time_ns) override;
  void Close() { writer_.Close(); }

 private:
  struct Held {
    std::uint16_t channel;
    std::int64_t time_ns;
    logs::Bytes message;
  };
  logs::McapWriter writer_;
  LogParams params_;
  std::vector<std::optional<std::uint16_t>> channels_;  // by topic; none: not logged
  std::deque<Held> held_;                               // the time before a possible fall
  std::int64_t write_until_ns_ = -1;
};

}  // namespace scoria::app
