// SPDX-License-Identifier: BSD-3-Clause
#include "logs/survey.h"

#include <algorithm>
#include <limits>

#include "logs/channel_types.h"
#include "logs/format/csv_log.h"
#include "logs/interval_histogram.h"
#include "logs/ros/check_message.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/message_error.h"

namespace scoria::logs {
namespace {

constexpr double kSecondsPerNs = 1e-9;

/// a - b, or the outermost number on the side where that does not fit.
std::int64_t Difference(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a > b ? std::numeric_limits<std::int64_t>::max()
               : std::numeric_limits<std::int64_t>::min();
}

void Include(std::optional<LogSpan>& span, std::int64_t time_ns) {
  if (!span) span = {time_ns, time_ns};
  span->first_ns = std::min(span->first_ns, time_ns);
  span->last_ns = std::max(span->last_ns, time_ns);
}

class ClockMeter {
 public:
  void Add(std::int64_t time_ns) {
    if (survey_.stamps++ > 0) AddStep(Difference(time_ns, last_ns_));
    Include(survey_.span, time_ns);
    last_ns_ = time_ns;
  }

  [[nodiscard]] ClockSurvey Finish() const {
    ClockSurvey survey = survey_;
    if (survey.stamps < 2) return survey;
    survey.regular_share = 0.0;
    if (forward_.count() == 0) return survey;
    const double median_ns = forward_.Quantile_ns(0.5);
    survey.median_step_s = median_ns * kSecondsPerNs;
    const std::uint64_t regular = forward_.CountWithin((1.0 - kRegularWithin) * median_ns,
                                                       (1.0 + kRegularWithin) * median_ns);
    survey.regular_share = static_cast<double>(regular) / static_cast<double>(survey.stamps - 1);
    return survey;
  }

 private:
  void AddStep(std::int64_t step_ns) {
    if (step_ns < 0) {
      ++survey_.backward;
    } else if (step_ns == 0) {
      ++survey_.repeated;
    } else {
      forward_.Add(step_ns);
      survey_.longest_step_s =
          std::max(survey_.longest_step_s, static_cast<double>(step_ns) * kSecondsPerNs);
    }
  }

  ClockSurvey survey_;
  IntervalHistogram forward_;
  std::int64_t last_ns_ = 0;
};

/// Differences of two clocks; beside the first of them, so that two clocks with other origins are
/// told apart to the nanosecond.
class DifferenceMeter {
 public:
  void Add(std::int64_t difference_ns) {
    if (beside_first_.count() == 0) first_ns_ = smallest_ns_ = largest_ns_ = difference_ns;
    smallest_ns_ = std::min(smallest_ns_, difference_ns);
    largest_ns_ = std::max(largest_ns_, difference_ns);
    beside_first_.Add(Difference(difference_ns, first_ns_));
  }

  [[nodiscard]] std::optional<ClockDifference> Finish() const {
    if (beside_first_.count() == 0) return std::nullopt;
    const double median_ns = static_cast<double>(first_ns_) + beside_first_.Quantile_ns(0.5);
    return ClockDifference{median_ns * kSecondsPerNs,
                           static_cast<double>(smallest_ns_) * kSecondsPerNs,
                           static_cast<double>(largest_ns_) * kSecondsPerNs};
  }

 private:
  IntervalHistogram beside_first_;
  std::int64_t first_ns_ = 0, smallest_ns_ = 0, largest_ns_ = 0;
};

/// The stamps within messages, by one definition.
class StampMeter {
 public:
  StampMeter(const MessageType& type, const std::string& path)
      : path_(path), reader_(type, {path}) {}

  /// Errors: MessageError.
  void Add(const LogMessage& m) {
    const std::int64_t stamp_ns = reader_.Read(m.data)[0].Int();
    clock_.Add(stamp_ns);
    differences_.Add(Difference(m.log_time_ns, stamp_ns));
  }

  void Finish(ChannelSurvey& survey) const {
    survey.header = clock_.Finish();
    survey.header_path = path_;
    survey.receive_after_header = differences_.Finish();
  }

 private:
  std::string path_;
  FieldReader reader_;
  ClockMeter clock_;
  DifferenceMeter differences_;
};

class ChannelMeter {
 public:
  ChannelMeter(const LogChannel& channel, TypeChoice choice) : survey_(std::move(choice)) {
    survey_.is_table = channel.message_encoding == kCsvEncoding;
  }

  void Add(const LogMessage& m) {
    ++survey_.messages;
    survey_.bytes += m.data.size();
    receive_.Add(m.log_time_ns);
    if (survey_.is_table || !Fits(m)) return;
    FollowType();
    try {
      if (stamps_) stamps_->Add(m);
    } catch (const MessageError&) {
      // counted where messages are shown to the choice
    }
  }

  [[nodiscard]] ChannelSurvey Finish() && {
    survey_.receive = receive_.Finish();
    if (survey_.is_table) return std::move(survey_);
    FollowType();
    if (stamps_) stamps_->Finish(survey_);
    const TypeCandidate* const taken = survey_.type.taken();
    if (taken == nullptr) {
      survey_.undecoded = survey_.messages;
    } else if (taken->misfits > 0) {
      survey_.undecoded += taken->misfits;
      survey_.first_undecoded = taken->first_misfit;
    }
    return std::move(survey_);
  }

 private:
  /// Shows a message to the choice; once that is settled, holds it against what is taken.
  bool Fits(const LogMessage& m) {
    if (!survey_.type.IsSettled()) {
      survey_.type.Show(m.data);
      return true;
    }
    const TypeCandidate* const taken = survey_.type.taken();
    if (taken == nullptr) return false;
    try {
      (void)MeasureRest(taken->type, m.data);
      return true;
    } catch (const MessageError& error) {
      if (survey_.undecoded++ == 0) survey_.first_undecoded = error.what();
      return false;
    }
  }

  /// Stamps that were read by another definition than the one that is taken now are forgotten.
  void FollowType() {
    const TypeCandidate* const taken = survey_.type.taken();
    if (taken == read_by_) return;
    read_by_ = taken;
    stamps_.reset();
    if (taken == nullptr) return;
    if (const auto path = StampPathOf(taken->type)) stamps_.emplace(taken->type, *path);
  }

  ChannelSurvey survey_;
  ClockMeter receive_;
  const TypeCandidate* read_by_ = nullptr;
  std::optional<StampMeter> stamps_;
};

}  // namespace

std::optional<double> ClockSurvey::rate_Hz() const {
  if (!median_step_s) return std::nullopt;
  return 1.0 / *median_step_s;
}

LogSurvey SurveyLog(LogSource& log, const TypeResolver& resolver) {
  std::vector<ChannelMeter> meters;
  std::vector<TypeChoice> types = ResolveTypes(log.contents(), resolver);
  for (std::size_t i = 0; i < types.size(); ++i)
    meters.emplace_back(log.contents().channels[i], std::move(types[i]));
  LogSurvey survey;
  log.ForEach({.order = LogOrder::kStored}, [&](const LogMessage& m) {
    ++survey.messages;
    Include(survey.span, m.log_time_ns);
    meters.at(m.channel_index).Add(m);
  });
  for (ChannelMeter& meter : meters) survey.channels.push_back(std::move(meter).Finish());
  return survey;
}

}  // namespace scoria::logs
