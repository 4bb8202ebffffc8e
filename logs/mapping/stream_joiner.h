// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "logs/mapping/signals.h"

namespace scoria::logs {

/// A topic whose messages go into rows.
struct StreamSettings {
  std::vector<SignalId> signals;
  std::int64_t max_age_ns = 0;     // of a sample in a row
  std::int64_t reorder_ns = 0;     // messages may come so much late
  std::int64_t derivative_ns = 0;  // a row wants neighbours so far away; 0: none
};

/// Joins streams of samples on one clock into rows: a row for every sample of the base stream.
/// Signals of the others are interpolated between their neighbours, or held, or are events
/// (SignalJoining); beyond the maximal age they are absent. At equal times they are exactly the
/// sample's. Keeps what lies between the oldest row that waits and the newest sample, two seconds
/// at most: a stream that is silent for longer is not waited for. Samples that are more than
/// kMostReorder_ns late are left out, unless ten come in a row: then the clock was set back, and
/// what follows is joined anew.
class StreamJoiner {
 public:
  static constexpr std::int64_t kMostReorder_ns = 500'000'000;

  /// What a row can ask for while it is made.
  class Instant {
   public:
    Instant(const StreamJoiner& joiner, std::int64_t time_ns)
        : joiner_(joiner), time_ns_(time_ns) {}
    [[nodiscard]] std::int64_t time_ns() const noexcept { return time_ns_; }
    /// A signal at so much before or after the row; not for events.
    [[nodiscard]] std::optional<SignalValues> At(SignalId id, std::int64_t after_ns = 0) const;
    /// Half the time over which derivatives of a signal are taken.
    [[nodiscard]] std::int64_t derivative_ns(SignalId id) const;

   private:
    const StreamJoiner& joiner_;
    std::int64_t time_ns_;
  };
  /// @param signals  joined; of the instant's neighbours more can be asked for.
  using OnRow = std::function<void(const Instant& instant, const SignalSet& signals)>;

  StreamJoiner(std::vector<StreamSettings> streams, std::size_t base, OnRow on_row);

  /// Takes a sample, by the settings' order of signals.
  void Add(std::size_t stream, std::int64_t time_ns,
           std::vector<std::optional<SignalValues>> signals);
  /// Makes the rows that are left.
  void Finish();

  [[nodiscard]] std::uint64_t num_late(std::size_t stream) const {
    return streams_[stream].num_late;
  }
  [[nodiscard]] std::uint64_t num_restarts() const { return num_restarts_; }

 private:
  struct Sample {
    std::int64_t time_ns = 0;
    std::vector<std::optional<SignalValues>> signals;
  };
  struct Stream {
    StreamSettings settings;
    std::deque<Sample> samples;  // by time
    std::optional<std::int64_t> newest_ns;
    std::uint64_t num_late = 0;
    int late_in_a_row = 0;
  };
  struct Place {
    std::size_t stream = 0, signal = 0;
  };

  static bool IsBefore(std::int64_t time_ns, const Sample& sample) {
    return time_ns < sample.time_ns;
  }
  bool IsFarBehind(Stream& stream, std::int64_t time_ns);
  static void Insert(Stream& stream, Sample sample);
  void MakeReadyRows();
  [[nodiscard]] bool IsReady(std::int64_t time_ns) const;
  void MakeRow(const Sample& base);
  void Prune(std::int64_t time_ns);
  [[nodiscard]] std::optional<SignalValues> ValueAt(Place place, SignalId id,
                                                    std::int64_t time_ns) const;
  [[nodiscard]] std::optional<SignalValues> EventAt(Place place, std::int64_t time_ns) const;

  std::vector<Stream> streams_;
  std::size_t base_;
  OnRow on_row_;
  PerSignal<Place> places_;
  std::deque<Sample> waiting_;             // of the base stream: rows to be made, by time
  std::optional<std::int64_t> newest_ns_;  // of all streams
  std::optional<std::int64_t> last_row_ns_;
  std::uint64_t num_restarts_ = 0;
};

}  // namespace scoria::logs
