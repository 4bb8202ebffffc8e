// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/stream_joiner.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/logs/mapping/times.h"

namespace scoria::logs {
namespace {

using test::kMs;
constexpr auto kContinuous = SignalId::kBatteryVoltage;
constexpr auto kHeld = SignalId::kCommandVx;
constexpr auto kEvent = SignalId::kMpcTime;

/// A row of one other signal: its time in ms, and the value.
struct JoinedRow {
  double time_ms = 0.0;
  std::optional<double> value;
  bool operator==(const JoinedRow&) const = default;
};
using Rows = std::vector<JoinedRow>;

/// Joins one scalar signal to a base stream of nothing but times.
class Joined {
 public:
  explicit Joined(SignalId id, std::int64_t max_age_ns = 30 * kMs, std::int64_t reorder_ns = 0)
      : joiner_({{{SignalId::kJointQ}, 0, reorder_ns, 0}, {{id}, max_age_ns, reorder_ns, 0}}, 0,
                [this, id](const StreamJoiner::Instant& instant, const SignalSet& signals) {
                  const auto& value = signals[static_cast<std::size_t>(id)];
                  rows_.push_back({static_cast<double>(instant.time_ns()) / kMs,
                                   value ? std::optional((*value)[0]) : std::nullopt});
                }) {}

  Joined& Base(double time_ms) {
    joiner_.Add(0, std::llround(time_ms * kMs), {SignalValues{}});
    return *this;
  }
  Joined& Other(double time_ms, std::optional<double> value) {
    joiner_.Add(1, std::llround(time_ms * kMs),
                {value ? std::optional(SignalValues{*value}) : std::nullopt});
    return *this;
  }
  const Rows& Finish() {
    joiner_.Finish();
    return rows_;
  }
  [[nodiscard]] std::size_t num_rows() const { return rows_.size(); }
  [[nodiscard]] const StreamJoiner& joiner() const { return joiner_; }

 private:
  Rows rows_;
  StreamJoiner joiner_;
};

constexpr std::nullopt_t kNone = std::nullopt;

TEST(StreamJoiner, ContinuousSignalsAreInterpolated) {
  Joined joined(kContinuous);
  joined.Other(0, 1.0).Base(0).Base(5).Other(10, 3.0).Base(10).Base(12);
  EXPECT_EQ(joined.Finish(), (Rows{{0, 1.0}, {5, 2.0}, {10, 3.0}, {12, 3.0}}));
}

TEST(StreamJoiner, DiscreteSignalsAreHeld) {
  Joined joined(kHeld);
  joined.Base(-1).Other(0, 1.0).Base(0).Base(5).Other(10, 3.0).Base(10).Base(12);
  EXPECT_EQ(joined.Finish(), (Rows{{-1, kNone}, {0, 1.0}, {5, 1.0}, {10, 3.0}, {12, 3.0}}));
}

TEST(StreamJoiner, EventsAreInOneRow) {
  Joined joined(kEvent);
  joined.Base(0).Other(3, 7.0).Base(5).Base(10).Other(15, 8.0).Base(15).Base(20);
  EXPECT_EQ(joined.Finish(), (Rows{{0, kNone}, {5, 7.0}, {10, kNone}, {15, 8.0}, {20, kNone}}));
}

TEST(StreamJoiner, BeyondTheMaximalAgeIsAbsent) {
  for (const SignalId id : {kContinuous, kHeld}) {
    Joined joined(id, 10 * kMs);
    joined.Other(0, 1.0).Base(10).Base(11).Base(49).Other(60, 1.0).Base(70).Base(71);
    EXPECT_EQ(joined.Finish(), (Rows{{10, 1.0}, {11, kNone}, {49, kNone}, {70, 1.0}, {71, kNone}}));
  }
}

TEST(StreamJoiner, AnAbsentValueIsNotBridgedByHolding) {
  Joined joined(kHeld);
  joined.Other(0, 1.0).Base(1).Other(2, std::nullopt).Base(3).Other(4, 2.0).Base(5);
  EXPECT_EQ(joined.Finish(), (Rows{{1, 1.0}, {3, kNone}, {5, 2.0}}));
}

TEST(StreamJoiner, MessagesOutOfOrderAreSorted) {
  Joined joined(kContinuous, 30 * kMs, 10 * kMs);
  joined.Other(0, 0.0).Base(2).Other(8, 8.0).Other(4, 0.0).Base(6).Base(4).Other(20, 20.0).Base(20);
  EXPECT_EQ(joined.Finish(), (Rows{{2, 0.0}, {4, 0.0}, {6, 4.0}, {20, 20.0}}));
}

TEST(StreamJoiner, ASilentStreamIsNotWaitedForForEver) {
  Joined joined(kContinuous);
  for (int i = 0; i < 5000; ++i) joined.Base(i);
  EXPECT_GE(joined.num_rows(), 2900u);
  EXPECT_LT(joined.num_rows(), 3100u);
  EXPECT_EQ(joined.Finish().size(), 5000u);
}

TEST(StreamJoiner, OneLateMessageIsLeftOutAndManyAreAClockSetBack) {
  Joined joined(kHeld, 1000 * kMs);
  joined.Other(0, 1.0);
  for (int i = 0; i < 3; ++i) joined.Base(1000.0 * i);
  joined.Base(100.0);
  EXPECT_EQ(joined.joiner().num_late(0), 1u);
  EXPECT_EQ(joined.joiner().num_restarts(), 0u);
  for (int i = 0; i < 20; ++i) joined.Base(i);
  EXPECT_EQ(joined.joiner().num_restarts(), 1u);
  const Rows& rows = joined.Finish();
  EXPECT_EQ(rows.size(), 3u + 12u);  // the first eight of them came before it was seen
  EXPECT_EQ(rows[3].time_ms, 8.0);
}

TEST(StreamJoiner, RowsOfOneTimeKeepTheirOwnSamples) {
  std::vector<double> own;
  StreamJoiner joiner({{{SignalId::kJointQ}, 0, 0, 0}, {{kHeld}, 100 * kMs, 0, 0}}, 0,
                      [&](const StreamJoiner::Instant&, const SignalSet& signals) {
                        own.push_back((*signals[static_cast<std::size_t>(SignalId::kJointQ)])[0]);
                      });
  for (const double value : {1.0, 2.0, 3.0}) joiner.Add(0, 5 * kMs, {SignalValues{value}});
  joiner.Add(1, 6 * kMs, {SignalValues{}});
  EXPECT_EQ(own, (std::vector<double>{1.0, 2.0, 3.0}));
}

TEST(StreamJoiner, AttitudesTakeTheShorterWay) {
  std::optional<SignalValues> middle;
  StreamJoiner joiner({{{SignalId::kJointQ}, 0, 0, 0}, {{SignalId::kImuAttitude}, 100 * kMs, 0, 0}},
                      0, [&](const StreamJoiner::Instant&, const SignalSet& signals) {
                        middle = signals[static_cast<std::size_t>(SignalId::kImuAttitude)];
                      });
  const double c = std::cos(0.1), s = std::sin(0.1);
  joiner.Add(1, 0, {SignalValues{c, s, 0, 0}});
  joiner.Add(0, 5 * kMs, {SignalValues{}});
  joiner.Add(1, 10 * kMs, {SignalValues{-c, s, 0, 0}});  // the same as c, -s
  joiner.Finish();
  ASSERT_TRUE(middle);
  EXPECT_NEAR(std::abs((*middle)[0]), c, 1e-12);
  EXPECT_NEAR((*middle)[1], 0.0, 1e-12);
}

}  // namespace
}  // namespace scoria::logs
