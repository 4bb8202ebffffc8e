// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/contact_metrics.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/estimation_metrics.h"
#include "core/robot/contact.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

using test::kRow_s;

/// A trot of 0.2 s stance and 0.2 s swing on row numbers; all legs alike.
struct Trot {
  static constexpr long kHalf = 100;
  [[nodiscard]] static bool Stance(long row) { return row >= 0 && (row / kHalf) % 2 == 1; }
};

using Reports = std::function<void(long row, logs::Row&)>;
ContactMetrics RunTrot(long rows, const Reports& report) {
  ContactAccumulator e;
  for (long i = 0; i < rows; ++i) {
    logs::Row row = test::WholeRow();
    row.episode->operating = true;
    row.time_s = kRow_s * static_cast<double>(i);
    row.true_contacts->contact.fill(Trot::Stance(i));
    report(i, row);
    e.AddRow(row);
  }
  return e.metrics();
}

TEST(Contact, DelaysAreMeasuredOnTheGridOfRows) {
  const ContactMetrics m = RunTrot(20050, [](long i, logs::Row& row) {
    row.contacts->sensor->contact.fill(Trot::Stance(i - 4));  // 8 ms late
    row.plan->stance.fill(Trot::Stance(i + 10));              // 20 ms early
    row.contacts->observer->contact.fill(Trot::Stance(i) ||
                                         Trot::Stance(i - 3));  // lifts off 6 ms late
    row.contacts->contact.fill(Trot::Stance(i));
  });
  const ContactQuality& sensor = m.of(ContactDetector::kSensor);
  EXPECT_NEAR(sensor.touchdown.delays.Quantile(0.5), 0.008, 1e-12);
  EXPECT_NEAR(sensor.touchdown.delays.Quantile(0.95), 0.008, 1e-12);
  EXPECT_NEAR(sensor.liftoff.delays.Quantile(0.5), 0.008, 1e-12);
  EXPECT_EQ(sensor.touchdown.true_edges(), 400u);
  EXPECT_EQ(sensor.touchdown.missed + sensor.touchdown.false_alarms, 0u);
  EXPECT_EQ(sensor.liftoff.missed + sensor.liftoff.false_alarms, 0u);
  EXPECT_EQ(sensor.Accuracy(), 1.0);  // within 15 ms of the edges nobody is judged
  const ContactQuality& plan = m.of(ContactDetector::kPlan);
  EXPECT_NEAR(plan.touchdown.delays.Quantile(0.5), -0.020, 1e-12);
  EXPECT_NEAR(plan.liftoff.delays.Quantile(0.5), -0.020, 1e-12);
  EXPECT_NEAR(plan.Accuracy(), 1.0 - 2.0 / 84.0, 1e-3);  // 2 of the 84 judged rows of a half
  EXPECT_NEAR(m.of(ContactDetector::kObserver).liftoff.delays.Quantile(0.5), 0.006, 1e-12);
  EXPECT_NEAR(m.of(ContactDetector::kObserver).touchdown.delays.Quantile(0.5), 0.0, 1e-12);
  EXPECT_FALSE(m.of(ContactDetector::kFused).differed);
  EXPECT_TRUE(m.HasDetection());
}

// The same walk at other row rates has the same numbers: limits are times, not row counts.
TEST(Contact, RowRateDoesNotMatter) {
  const auto run = [](double row_s) {
    ContactAccumulator e;
    for (long i = 0; i < std::lround(20.02 / row_s); ++i) {
      const double t = row_s * static_cast<double>(i);
      const auto stance = [](double at) { return at >= 0.0 && std::fmod(at, 0.4) >= 0.2 - 1e-9; };
      logs::Row row = test::WholeRow();
      row.episode->operating = true;
      row.time_s = t;
      const bool scuff = std::fmod(t, 0.4) > 0.1 - 1e-9 && std::fmod(t, 0.4) < 0.108 - 1e-9;
      row.true_contacts->contact.fill(stance(t) || scuff);
      row.contacts->contact.fill(stance(t - 0.012) || (scuff && row_s > 0.0));
      e.AddRow(row);
    }
    return e.metrics().of(ContactDetector::kFused);
  };
  for (const double row_s : {0.001, 0.002, 0.004}) {
    const ContactQuality q = run(row_s);
    EXPECT_EQ(q.Accuracy(), 1.0) << row_s;  // 12 ms late is within 15 ms of the edge
    EXPECT_EQ(q.touchdown.true_edges(), 4u * 50u) << row_s;  // 8 ms are a scuff
    EXPECT_NEAR(q.touchdown.delays.Quantile(0.5), 0.012, 1e-9) << row_s;
    EXPECT_EQ(q.touchdown.false_alarms, 0u) << row_s;
  }
}

TEST(Contact, MissedAndFalseTouchdownsAreCounted) {
  const ContactMetrics m = RunTrot(20050, [](long i, logs::Row& row) {
    const long stride = i / 200, at = i % 200;
    const bool deaf = stride % 4 == 0, hears_things = stride % 5 == 0 && at >= 40 && at < 46;
    row.contacts->contact.fill((Trot::Stance(i) && !deaf) || hears_things);
    row.contacts->sensor->contact.fill(true);  // never notices a swing
    row.contacts->observer->contact.fill(Trot::Stance(i) &&
                                         !(at >= 150 && at < 153));  // flickers in stance
  });
  const ContactQuality& fused = m.of(ContactDetector::kFused);
  EXPECT_EQ(fused.touchdown.missed, 4u * 25u);
  EXPECT_EQ(fused.touchdown.false_alarms, 4u * 20u);
  EXPECT_EQ(fused.touchdown.delays.count(), 4u * 75u);
  const ContactQuality& sensor = m.of(ContactDetector::kSensor);
  EXPECT_EQ(sensor.touchdown.delays.count(), 0u);
  EXPECT_EQ(sensor.touchdown.missed, 4u * 99u);  // the first swing began unseen
  EXPECT_EQ(sensor.liftoff.missed, 4u * 99u);
  EXPECT_EQ(sensor.FalsePositiveRate(), 1.0);
  const ContactQuality& observer = m.of(ContactDetector::kObserver);
  EXPECT_EQ(observer.liftoff.false_alarms, 4u * 100u);
  EXPECT_EQ(observer.touchdown.false_alarms, 0u);
}

TEST(Contact, ScuffsAreNeitherTouchdownsNorFalse) {
  const ContactMetrics m = RunTrot(4050, [](long i, logs::Row& row) {
    const long at = i % 200;
    if (at >= 50 && at < 54) row.true_contacts->contact.fill(true);     // 8 ms in swing
    if (at >= 150 && at < 154) row.true_contacts->contact.fill(false);  // a bounce in stance
    row.contacts->contact = row.true_contacts->contact;
  });
  const ContactQuality& fused = m.of(ContactDetector::kFused);
  EXPECT_EQ(fused.touchdown.true_edges(), 4u * 20u);
  EXPECT_EQ(fused.touchdown.false_alarms, 0u);
  EXPECT_EQ(fused.liftoff.false_alarms, 0u);
  EXPECT_EQ(fused.Accuracy(), 1.0);
}

TEST(Contact, AreaUnderTheCurveIsThatOfTheOrder) {
  // Stance shows 10 or 30 counts by turns, swing 0 or 10: of four pairs three are in order and one
  // is tied.
  const ContactMetrics m = RunTrot(20050, [](long i, logs::Row& row) {
    const bool even = i % 2 == 0;
    row.contacts->sensor->counts.fill(Trot::Stance(i) ? (even ? 10.0 : 30.0) : (even ? 0.0 : 10.0));
    row.contacts->observer->probability.fill(Trot::Stance(i) ? 1.0 : 0.0);
    row.contacts->sensor->contact.fill(Trot::Stance(i));
  });
  EXPECT_NEAR(m.sensor.Area(), 0.875, 1e-9);
  EXPECT_NEAR(m.observer.Area(), 1.0, 1e-12);
  const std::vector<RocPoint> curve = m.sensor.Curve();
  ASSERT_EQ(curve.size(), 4u);
  EXPECT_NEAR(curve[1].true_positive_rate, 0.5, 1e-9);
  EXPECT_NEAR(curve[1].false_positive_rate, 0.0, 1e-12);
  EXPECT_NEAR(curve[2].false_positive_rate, 0.5, 1e-9);
  EXPECT_TRUE(std::isnan(Evidence().Area()));
}

TEST(Contact, DistrustAndSourcesAreCounted) {
  const ContactMetrics m = RunTrot(1000, [](long i, logs::Row& row) {
    row.contacts->sensor->healthy.fill(true);
    row.contacts->sensor->healthy[2] = i < 400 || i >= 600;
    row.contacts->source->fill(static_cast<std::uint8_t>(ContactSource::kSensor));
    (*row.contacts->source)[1] = static_cast<std::uint8_t>(ContactSource::kObserver);
  });
  EXPECT_EQ(m.leg_rows, 4000u);
  EXPECT_EQ(m.distrusted_rows, 200u);
  EXPECT_EQ(m.distrusted_times, 1u);
  EXPECT_EQ(m.fused_from[static_cast<std::size_t>(ContactSource::kSensor)], 3000u);
  EXPECT_EQ(m.fused_from[static_cast<std::size_t>(ContactSource::kObserver)], 1000u);
}

TEST(Contact, PlacementsBreakTheMatching) {
  EstimationAccumulator e;
  for (long i = 0; i < 400; ++i) {
    logs::Row row = test::WholeRow();
    row.episode->operating = true;
    row.time_s = kRow_s * static_cast<double>(i);
    row.episode->segment = i < 200 ? 1 : 2;
    row.true_contacts->contact.fill(i >= 200);  // set on its feet: no touchdown
    row.contacts->contact.fill(i >= 220);
    e.AddRow(row);
  }
  const ContactQuality fused = e.Finish().contact.of(ContactDetector::kFused);
  EXPECT_EQ(fused.touchdown.true_edges(), 0u);
  EXPECT_EQ(fused.stance_rows, 4u * 184u);
  EXPECT_EQ(fused.stance_right, 4u * 172u);
}

// There, the fused contact was the one that "counted", and a detector's report its "word".
TEST(Contact, ResultsOfVersion010AreRead) {
  const ContactMetrics m = RunTrot(1000, [](long row, logs::Row& r) {
    r.contacts->sensor->contact.fill(row % 100 < 40);
    r.contacts->sensor->healthy.fill(row > 10);
  });
  nlohmann::json older = m;
  older["words"] = older.at("detectors");
  older["words"]["counted"] = older.at("detectors").at("fused");
  older["words"].erase("fused");
  for (auto& [name, detector] : older.at("words").items()) {
    detector["spoke"] = detector.at("reported");
    detector.erase("reported");
  }
  older["counted_from"] = older.at("fused_from");
  for (const char* key : {"detectors", "fused_from", "sensor_rows"}) older.erase(key);
  ContactMetrics expected = m;
  expected.sensor_rows = 0;  // nobody counted them
  EXPECT_EQ(older.get<ContactMetrics>(), expected);
}

}  // namespace
}  // namespace scoria::analysis
