// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/verify.h"

#include <algorithm>
#include <map>
#include <optional>

#include "app/episode/episode.h"
#include "app/episode/record.h"
#include "app/run/log_origin.h"
#include "core/hash.h"
#include "logs/format/open_log.h"
#include "logs/messages/read_messages.h"

namespace scoria::app {
namespace {

std::uint64_t HashBytes(std::span<const std::byte> bytes) {
  core::Hash64 hash;
  hash.Add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return hash.value();
}

struct Logged {
  std::int64_t time_ns;
  std::uint64_t hash;
};

/// Ctrl-C ended the episode here, which no re-run can know.
bool IsInterruption(const logs::LogMessage& m) {
  if (m.channel.topic != "/scoria/event") return false;
  const auto event = logs::Decode<logs::msg::Event>(m);
  return event.kind == "end" && event.detail == core::EnumName(EpisodeEnd::kInterrupted);
}

/// The bytes of one message of the log.
logs::Bytes Fetch(const std::filesystem::path& log, const std::string& topic, std::size_t index) {
  logs::Bytes bytes;
  std::size_t seen = 0;
  logs::OpenLog(log)->ForEach({.topics = {{topic}}, .order = logs::LogOrder::kStored},
                              [&](const logs::LogMessage& m) {
                                if (seen++ != index) return true;
                                bytes.assign(m.data.begin(), m.data.end());
                                return false;
                              });
  return bytes;
}

/// Compares what the re-run writes with what the log holds.
class CompareSink final : public MessageSink {
 public:
  CompareSink(const std::filesystem::path& log, const Scenario& scenario)
      : log_(log),
        step_s_(scenario.physics.step_s),
        params_(scenario.log),
        complete_(scenario.log.keep == KeepLog::kFull) {
    std::optional<std::int64_t> interrupted_ns;
    const std::unique_ptr<logs::LogSource> source = logs::OpenLog(log);
    const auto take = [&](const logs::LogMessage& m) {
      if (IsInterruption(m)) {
        interrupted_ns = m.log_time_ns;
        return;
      }
      logged_[m.channel.topic].push_back({m.log_time_ns, HashBytes(m.data)});
      last_ns_ = std::max(last_ns_, m.log_time_ns);
    };
    problems_ = logs::ReadMessages(*source, {.order = logs::LogOrder::kStored}, take);
    if (IsDamaged()) complete_ = false;
    whole_ = !logs::LosesData(problems_) && !interrupted_ns;
    // The step that an interruption names was not run. A cut log may end in the middle of a step:
    // the last step's messages are not all there.
    if (interrupted_ns) last_ns_ = *interrupted_ns - 1;
    if (logs::LosesData(problems_)) --last_ns_;
  }

  void Write(const Topic& topic, std::int64_t time_ns,
             std::span<const std::byte> message) override {
    if (!topic.reproducible || !IsLogged(topic, params_)) return;
    if (!difference_.empty() || time_ns > last_ns_) return;
    const std::vector<Logged>& kept = logged_[topic.name];
    std::size_t& next = next_[topic.name];
    if (next >= kept.size() || kept[next].time_ns > time_ns) {
      // A log that keeps everything lacks nothing, up to where it was cut, unless it is damaged.
      if (complete_)
        difference_ = fmt::format("{}: {}: the re-run makes a message that the log lacks",
                                  At(time_ns), topic.name);
      return;
    }
    const Logged& logged = kept[next];
    if (logged.time_ns < time_ns) {
      difference_ = fmt::format("{}: {}: the log has a message that the re-run does not make",
                                At(logged.time_ns), topic.name);
    } else if (logged.hash != HashBytes(message)) {
      Explain(topic, time_ns, next, message);
    }
    ++next;
    ++compared_;
  }
  void MarkFall(std::int64_t) override {}

  [[nodiscard]] bool Finished(double time_s) const {
    return !difference_.empty() || time_s * 1e9 > static_cast<double>(last_ns_) + 1e6;
  }

  [[nodiscard]] VerifyResult Result() {
    for (const Topic& topic : RecordedTopics()) {
      const auto found = logged_.find(topic.name);
      if (!topic.reproducible || found == logged_.end() || !difference_.empty()) continue;
      const std::size_t next = next_[topic.name];
      if (next < found->second.size() && found->second[next].time_ns <= last_ns_) {
        difference_ = fmt::format("{}: {}: the log has a message that the re-run does not make",
                                  At(found->second[next].time_ns), topic.name);
      }
    }
    const bool before_first_step =  // nothing to prove
        !logs::LosesData(problems_) && !whole_ && last_ns_ < 0;
    if (compared_ == 0 && difference_.empty() && !before_first_step)
      difference_ = whole_ ? "the log has no message that could be compared"
                           : "the log ends before a whole step that could be compared";
    const std::string problem = logs::ProblemText(problems_);
    if (IsDamaged() && difference_.empty()) difference_ = problem;
    return {difference_.empty(),
            compared_,
            whole_,
            1e-9 * static_cast<double>(std::max<std::int64_t>(last_ns_, 0)),
            difference_,
            problem,
            MissingTopics(params_)};
  }

 private:
  /// More than cut off.
  [[nodiscard]] bool IsDamaged() const {
    return std::any_of(problems_.begin(), problems_.end(), [](const logs::LogProblem& p) {
      return p.kind == logs::LogProblem::Kind::kLost;
    });
  }

  [[nodiscard]] std::string At(std::int64_t time_ns) const {
    const double time_s = static_cast<double>(time_ns) * 1e-9;
    return fmt::format("step {} ({:.3f} s)", std::lround(time_s / step_s_), time_s);
  }

  void Explain(const Topic& topic, std::int64_t time_ns, std::size_t index,
               std::span<const std::byte> message) {
    difference_ = fmt::format("{}: {}: differs", At(time_ns), topic.name);
    const logs::Bytes logged = Fetch(log_, topic.name, index);
    try {
      const auto theirs = topic.list_fields(logged), ours = topic.list_fields(message);
      for (std::size_t i = 0; i < std::min(theirs.size(), ours.size()); ++i) {
        if (theirs[i] == ours[i]) continue;
        difference_ = fmt::format("{}: {}: {}: the log says {}, the re-run {}", At(time_ns),
                                  topic.name, ours[i].first, theirs[i].second, ours[i].second);
        return;
      }
    } catch (const std::exception& e) {
      difference_ += fmt::format(" and cannot be decoded ({})", e.what());
    }
  }

  std::filesystem::path log_;
  double step_s_;
  LogParams params_;
  bool complete_;
  std::map<std::string, std::vector<Logged>> logged_;
  std::map<std::string, std::size_t> next_;
  bool whole_ = true;          // neither cut off nor interrupted
  std::int64_t last_ns_ = -1;  // of what is compared
  std::uint64_t compared_ = 0;
  std::string difference_;
  std::vector<logs::LogProblem> problems_;
};

}  // namespace

VerifyResult VerifyLog(const std::filesystem::path& log) {
  const LogOrigin origin = ReadLogOrigin(log);
  const core::RobotDescription robot = RobotOf(origin);
  const terrains::Heightfield ground = GroundOf(origin);
  CompareSink sink(log, origin.scenario);
  Recorder recorder(sink, origin.scenario);
  const auto episode = std::make_unique<Episode>(origin.scenario, robot, ground);
  episode->Attach(recorder);
  // A log that ends early is compared as far as it goes.
  while (!episode->ended() && !sink.Finished(episode->time_s())) episode->Step();
  return sink.Result();
}

}  // namespace scoria::app
