// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/stream_joiner.h"

#include <algorithm>
#include <cmath>

namespace scoria::logs {
namespace {

constexpr std::int64_t kLongestWait_ns = 2'000'000'000;

/// Between two samples; quaternions along the nearer of two ways.
SignalValues Blend(const SignalValues& a, const SignalValues& b, double share, bool is_attitude) {
  SignalValues out{};
  double sign = 1.0;
  if (is_attitude && a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0.0) sign = -1.0;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = a[k] + share * (sign * b[k] - a[k]);
  return out;
}

}  // namespace

std::optional<SignalValues> StreamJoiner::Instant::At(SignalId id, std::int64_t after_ns) const {
  const std::optional<Place>& place = joiner_.places_[static_cast<std::size_t>(id)];
  if (!place) return std::nullopt;
  return joiner_.ValueAt(*place, id, time_ns_ + after_ns);
}

std::int64_t StreamJoiner::Instant::derivative_ns(SignalId id) const {
  const std::optional<Place>& place = joiner_.places_[static_cast<std::size_t>(id)];
  return place ? joiner_.streams_[place->stream].settings.derivative_ns : 0;
}

StreamJoiner::StreamJoiner(std::vector<StreamSettings> streams, std::size_t base, OnRow on_row)
    : base_(base), on_row_(std::move(on_row)) {
  for (StreamSettings& settings : streams) {
    for (std::size_t i = 0; i < settings.signals.size(); ++i)
      places_[static_cast<std::size_t>(settings.signals[i])] = Place{streams_.size(), i};
    streams_.push_back({std::move(settings), {}, std::nullopt, 0, 0});
  }
}

void StreamJoiner::Add(std::size_t index, std::int64_t time_ns,
                       std::vector<std::optional<SignalValues>> signals) {
  Stream& stream = streams_[index];
  if (IsFarBehind(stream, time_ns)) return;
  if (index == base_) {
    const auto at = std::upper_bound(waiting_.begin(), waiting_.end(), time_ns, IsBefore);
    waiting_.insert(at, {time_ns, signals});
  }
  Insert(stream, {time_ns, std::move(signals)});
  newest_ns_ = std::max(newest_ns_.value_or(time_ns), time_ns);
  MakeReadyRows();
}

bool StreamJoiner::IsFarBehind(Stream& stream, std::int64_t time_ns) {
  constexpr int kSetBack = 10;
  const bool is_behind = stream.newest_ns && time_ns < *stream.newest_ns - kMostReorder_ns;
  if (!is_behind) {
    stream.late_in_a_row = 0;
    return false;
  }
  ++stream.num_late;
  if (++stream.late_in_a_row < kSetBack) return true;
  Finish();
  for (Stream& other : streams_) {
    other.samples.clear();
    other.newest_ns.reset();
    other.late_in_a_row = 0;
  }
  newest_ns_.reset();
  last_row_ns_.reset();
  ++num_restarts_;
  return false;
}

void StreamJoiner::Insert(Stream& stream, Sample sample) {
  stream.newest_ns = std::max(stream.newest_ns.value_or(sample.time_ns), sample.time_ns);
  const auto at =
      std::upper_bound(stream.samples.begin(), stream.samples.end(), sample.time_ns, IsBefore);
  stream.samples.insert(at, std::move(sample));
}

void StreamJoiner::MakeReadyRows() {
  while (!waiting_.empty() && IsReady(waiting_.front().time_ns)) {
    const Sample base = std::move(waiting_.front());
    waiting_.pop_front();
    MakeRow(base);
    Prune(base.time_ns);
  }
}

void StreamJoiner::Finish() {
  while (!waiting_.empty()) {
    MakeRow(waiting_.front());
    waiting_.pop_front();
  }
}

/// Whether nothing more can come that matters to a row.
bool StreamJoiner::IsReady(std::int64_t time_ns) const {
  if (*newest_ns_ >= time_ns + kLongestWait_ns) return true;
  return std::all_of(streams_.begin(), streams_.end(), [&](const Stream& stream) {
    const StreamSettings& settings = stream.settings;
    const std::int64_t until = time_ns + settings.reorder_ns + settings.derivative_ns;
    return settings.signals.empty() || (stream.newest_ns && *stream.newest_ns >= until);
  });
}

/// What the base stream has is the row's own sample, also where several are of one time.
void StreamJoiner::MakeRow(const Sample& base) {
  const std::int64_t time_ns = base.time_ns;
  SignalSet signals;
  for (const SignalTraits& traits : AllSignals()) {
    const auto k = static_cast<std::size_t>(traits.id);
    if (!places_[k]) continue;
    if (places_[k]->stream == base_) {
      signals[k] = base.signals[places_[k]->signal];
      continue;
    }
    signals[k] = traits.joining == SignalJoining::kEvent ? EventAt(*places_[k], time_ns)
                                                         : ValueAt(*places_[k], traits.id, time_ns);
  }
  on_row_(Instant(*this, time_ns), signals);
  last_row_ns_ = time_ns;
}

/// Forgets samples that no row from `time_ns` on needs.
void StreamJoiner::Prune(std::int64_t time_ns) {
  for (Stream& stream : streams_) {
    const std::int64_t from = time_ns - stream.settings.derivative_ns;
    while (stream.samples.size() > 1 && stream.samples[1].time_ns <= from)
      stream.samples.pop_front();
  }
}

std::optional<SignalValues> StreamJoiner::ValueAt(Place place, SignalId id,
                                                  std::int64_t time_ns) const {
  const Stream& stream = streams_[place.stream];
  const auto after =
      std::upper_bound(stream.samples.begin(), stream.samples.end(), time_ns, IsBefore);
  const std::int64_t max_age = stream.settings.max_age_ns;
  const Sample* left = after == stream.samples.begin() ? nullptr : &*std::prev(after);
  const Sample* right = after == stream.samples.end() ? nullptr : &*after;
  if (left != nullptr && time_ns - left->time_ns > max_age) left = nullptr;
  if (right != nullptr && right->time_ns - time_ns > max_age) right = nullptr;
  const auto value = [&](const Sample* sample) {
    return sample == nullptr ? std::nullopt : sample->signals[place.signal];
  };
  const bool is_exact = left != nullptr && left->time_ns == time_ns;
  const SignalTraits& traits = TraitsOf(id);
  if (is_exact || traits.joining == SignalJoining::kHold) return value(left);
  const std::optional<SignalValues> a = value(left), b = value(right);
  if (!a || !b) return a ? a : b;
  const double share = static_cast<double>(time_ns - left->time_ns) /
                       static_cast<double>(right->time_ns - left->time_ns);
  return Blend(*a, *b, share, traits.shape == SignalShape::kAttitude);
}

/// The last one since the row before.
std::optional<SignalValues> StreamJoiner::EventAt(Place place, std::int64_t time_ns) const {
  const Stream& stream = streams_[place.stream];
  const std::int64_t since =
      std::max(last_row_ns_.value_or(time_ns - stream.settings.max_age_ns - 1),
               time_ns - stream.settings.max_age_ns - 1);
  std::optional<SignalValues> event;
  for (const Sample& sample : stream.samples) {
    if (sample.time_ns > time_ns) break;
    if (sample.time_ns > since && sample.signals[place.signal])
      event = sample.signals[place.signal];
  }
  return event;
}

}  // namespace scoria::logs
