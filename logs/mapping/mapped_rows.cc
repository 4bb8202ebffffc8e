// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/mapped_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "logs/mapping/mapped_log.h"
#include "logs/mapping/row_maker.h"

namespace scoria::logs {
namespace {

constexpr std::int64_t kLeastDerivative_ns = 10'000'000;

bool NeedsDerivative(const MappingFile& file, SignalId id) {
  if (id == SignalId::kTruthPosition) return !file.truth->velocity;
  if (id == SignalId::kTruthAttitude) return !file.truth->rate;
  return id == SignalId::kEstimatePosition && !file.estimate->velocity;
}

StreamSettings SettingsOf(const Mapping& mapping, const MappedTopic& topic) {
  constexpr std::int64_t kPeriods = 3, kUnknown_ns = 1'000'000'000;
  StreamSettings settings;
  const std::int64_t step_ns = topic.step_ns().value_or(kUnknown_ns);
  settings.max_age_ns = kPeriods * step_ns;
  if (const auto max_age_s = topic.bound().max_age_s)
    settings.max_age_ns = std::llround(*max_age_s * 1e9);
  settings.reorder_ns = std::min(topic.largest_step_back_ns(), StreamJoiner::kMostReorder_ns);
  for (const std::size_t i : topic.bound().signals) {
    const SignalId id = mapping.signals()[i].id;
    settings.signals.push_back(id);
    if (NeedsDerivative(mapping.file(), id))
      settings.derivative_ns = std::max(kLeastDerivative_ns, step_ns);
  }
  return settings;
}

/// The second pass.
class RowPass {
 public:
  RowPass(LogSource& log, const Mapping& mapping, MappedLog& mapped,
          const std::function<void(const Row&)>& on_row)
      : log_(log),
        mapped_(mapped),
        maker_(mapping.file(), log.contents().metadata),
        on_row_(on_row),
        joiner_(Settings(mapping, mapped), mapped.base(),
                [this](const StreamJoiner::Instant& instant, const SignalSet& signals) {
                  MakeRow(instant, signals);
                }) {}

  void Run(MappingReport& report) {
    log_.ForEach(mapped_.Filter(), [&](const LogMessage& message) {
      const auto topic = mapped_.TopicOf(message.channel_index);
      if (!topic) return;
      auto sample = mapped_.topics()[*topic].Decode(message);
      if (!sample) return;
      const std::int64_t time_ns = mapped_.TimeOf(*topic, *sample);
      joiner_.Add(*topic, time_ns, std::move(sample->signals));
    });
    joiner_.Finish();
    report.num_rows = num_rows_;
    report.groups = groups_;
    if (origin_ns_ && *origin_ns_ != 0) report.start_ns = origin_ns_;
    report.problems = log_.problems();
    AddProblems(report);
  }

 private:
  static std::vector<StreamSettings> Settings(const Mapping& mapping, MappedLog& mapped) {
    std::vector<StreamSettings> settings;
    for (const MappedTopic& topic : mapped.topics()) settings.push_back(SettingsOf(mapping, topic));
    return settings;
  }

  void MakeRow(const StreamJoiner::Instant& instant, const SignalSet& signals) {
    if (!origin_ns_) origin_ns_ = instant.time_ns() >= kYear2000_ns ? instant.time_ns() : 0;
    const double time_s = 1e-9 * static_cast<double>(instant.time_ns() - *origin_ns_);
    const Row row = maker_.Make(time_s, instant, signals);
    groups_ |= GroupsOf(row);
    ++num_rows_;
    on_row_(row);
  }

  void AddProblems(MappingReport& report) const {
    const std::filesystem::path& path = log_.contents().path;
    const auto add = [&](LogProblem::Kind kind, std::string what) {
      report.problems.push_back({kind, path, std::move(what)});
    };
    for (std::size_t i = 0; i < report.topics.size(); ++i) {
      MappedTopicReport& topic = report.topics[i];
      topic.num_undecodable = mapped_.topics()[i].num_undecodable();
      topic.first_error = mapped_.topics()[i].first_error();
      topic.num_late = joiner_.num_late(i);
      const std::string why = mapped_.topics()[i].refusal();
      if (!why.empty())
        add(LogProblem::Kind::kLost, fmt::format("{}: none of its {} messages can be decoded: {}",
                                                 topic.topic, topic.num_messages, why));
      if (topic.num_undecodable > 0)
        add(LogProblem::Kind::kLost,
            fmt::format("{}: {} of {} messages cannot be decoded: {}", topic.topic,
                        topic.num_undecodable, topic.num_messages, topic.first_error));
      if (topic.num_late > 0)
        add(LogProblem::Kind::kOdd,
            fmt::format("{}: {} messages are more than 0.5 s older than one before them",
                        topic.topic, topic.num_late));
      if (topic.num_messages == 0)
        add(LogProblem::Kind::kOdd, fmt::format("{}: has no message", topic.topic));
    }
    if (joiner_.num_restarts() > 0)
      add(LogProblem::Kind::kOdd,
          fmt::format("the clock goes back {} times, and so do the rows", joiner_.num_restarts()));
  }

  LogSource& log_;
  MappedLog& mapped_;
  RowMaker maker_;
  const std::function<void(const Row&)>& on_row_;
  StreamJoiner joiner_;
  std::optional<std::int64_t> origin_ns_;
  std::uint64_t num_rows_ = 0;
  RowGroups groups_;
};

MappingReport BeginReport(const Mapping& mapping, MappedLog& mapped) {
  const MappingFile& file = mapping.file();
  MappingReport report;
  report.mapping = mapping.name();
  report.robot = file.robot;
  report.base_topic = mapped.binding().topics[mapped.base()].topic;
  report.absent = mapped.binding().absent;
  report.truth_is_of_markers = file.truth && file.truth->body == TruthBody::kMarkers &&
                               file.truth->p_BM_m == std::array<double, 3>{};
  for (const MappedTopic& topic : mapped.topics()) {
    MappedTopicReport& out = report.topics.emplace_back();
    out.name = topic.bound().name;
    out.topic = topic.bound().topic;
    out.num_messages = topic.num_messages();
    out.type = topic.DescribeType();
    out.clock = topic.DescribeClock();
  }
  return report;
}

}  // namespace

std::string DescribeReport(const MappingReport& report) {
  std::string text = fmt::format("mapping {}: {} rows, one for each message of {}\n",
                                 report.mapping, report.num_rows, report.base_topic);
  for (const MappedTopicReport& topic : report.topics) {
    text +=
        fmt::format("  {}: {} messages, clock {}", topic.topic, topic.num_messages, topic.clock);
    if (!topic.type.empty()) text += fmt::format(", definition: {}", topic.type);
    text += "\n";
  }
  std::vector<std::string_view> groups;
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    if (report.groups[static_cast<std::size_t>(group)]) groups.push_back(name);
  }
  if (!groups.empty()) text += fmt::format("  canonical signals: {}\n", fmt::join(groups, ", "));
  if (!report.absent.empty())
    text += fmt::format("  the log has no {}\n", fmt::join(report.absent, ", "));
  if (report.truth_is_of_markers)
    text += "  truth is of a body of markers, whose place on the trunk is not known\n";
  return text;
}

MappingReport ForEachMappedRow(LogSource& log, const Mapping& mapping, const TypeResolver& resolver,
                               const std::function<void(const Row&)>& on_row) {
  MappedLog mapped(log, mapping, resolver);
  MappingReport report = BeginReport(mapping, mapped);
  RowPass(log, mapping, mapped, on_row).Run(report);
  return report;
}

}  // namespace scoria::logs
