// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/read_series.h"

#include <cmath>
#include <memory>
#include <optional>

#include "logs/channel_types.h"
#include "logs/format/open_log.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/message_error.h"

namespace scoria::app {
namespace {

/// One field of one channel.
struct Wanted {
  std::string type, topic, field;
  bool changes_only = false;
  Series* series = nullptr;
};

/// Reads the wanted fields of a log's messages by the definitions that they fit.
class SeriesReader {
 public:
  SeriesReader(const logs::LogContents& contents, std::vector<Wanted> wanted)
      : wanted_(std::move(wanted)), types_(logs::ResolveTypes(contents, logs::TypeResolver())) {}

  void Add(const logs::LogMessage& message, double time_s) {
    for (const Wanted& w : wanted_) {
      if (message.channel.topic == w.topic && message.channel.type_name == w.type)
        Read(w, message, time_s);
    }
  }

 private:
  void Read(const Wanted& wanted, const logs::LogMessage& message, double time_s) {
    logs::TypeChoice& type = types_[message.channel_index];
    type.Show(message.data);
    if (type.taken() == nullptr) return;
    try {
      logs::FieldReader reader(type.taken()->type, {wanted.field});
      const auto values = reader.Read(message.data);
      if (!values[0].IsAbsent()) Take(wanted, {time_s, values[0].Double()});
    } catch (const logs::MessageError&) {
      // The mapping's report tells of messages that cannot be decoded.
    }
  }

  static void Take(const Wanted& wanted, const SeriesSample& sample) {
    Series& series = *wanted.series;
    if (wanted.changes_only && !series.empty() && series.back().value == sample.value) return;
    series.push_back(sample);
  }

  std::vector<Wanted> wanted_;
  std::vector<logs::TypeChoice> types_;  // by channel
};

}  // namespace

ReferenceSeries ReadReferenceSeries(const LogRows& rows, double first_row_s,
                                    const std::string& base_topic) {
  ReferenceSeries series;
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(rows.files());
  SeriesReader reader(
      log->contents(),
      {{"interfaces/msg/GaitState", "/gait_state", "gait_sequencer", true, &series.sequencer},
       {"std_msgs/msg/Float64", "/cpu_power_consumption", "data", false, &series.cpu_power_W}});
  std::optional<std::int64_t> start_ns;
  if (base_topic.empty()) start_ns = std::llround(1e9 * first_row_s);
  logs::LogFilter filter;
  filter.topics = {"/gait_state", "/cpu_power_consumption"};
  if (!base_topic.empty()) filter.topics->push_back(base_topic);
  log->ForEach(filter, [&](const logs::LogMessage& message) {
    if (!start_ns && message.channel.topic == base_topic) start_ns = message.log_time_ns;
    const std::int64_t since_ns = message.log_time_ns - start_ns.value_or(message.log_time_ns);
    reader.Add(message, first_row_s + 1e-9 * static_cast<double>(since_ns));
  });
  return series;
}

std::string SequencerName(double value) {
  if (value == 0.0) return "simple";
  if (value == 1.0) return "adaptive";
  return "bio-inspired";
}

}  // namespace scoria::app
