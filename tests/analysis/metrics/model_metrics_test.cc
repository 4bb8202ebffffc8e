// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/model_metrics.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metrics.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

using test::kRow_s;
constexpr double kRobot_kg = 15.0;

/// A robot at work whose adapter knows the true mass, to be spoiled row by row. Time is the index.
class Work {
 public:
  using Spoil = std::function<void(logs::Row&)>;
  Work() {
    row_.episode->operating = true;
    row_.model->learned->tared = true;
    row_.true_mass->mass_kg = kRobot_kg;
    row_.true_mass->p_BC_m = {0.01, -0.02, 0.0};
  }
  void Run(ModelAccumulator& m, double time_s, const Spoil& spoil) {
    for (long i = std::lround(time_s / kRow_s); i > 0; --i) {
      row_.time_s = kRow_s * static_cast<double>(index_++);
      logs::Row row = row_;
      row.model->learned->mass_kg = row.model->used_mass_kg = row.true_mass->mass_kg;
      row.model->learned->p_BC_m = row.true_mass->p_BC_m;
      spoil(row);
      m.AddRow(row);
    }
  }
  logs::Row row_ = test::WholeRow();

 private:
  long index_ = 0;
};

void Leave(logs::Row&) {}

TEST(Model, BiasAndRmseAreOfTheSettledPart) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 10.0, Leave);
  work.row_.true_mass->mass_kg = 20.0;
  long i = 0;
  work.Run(m, 10.0, [&i](logs::Row& row) {
    row.model->learned->mass_kg += row.time_s < 12.0 ? -5.0 : (i++ % 2 == 0 ? 0.3 : -0.1);
    row.model->used_mass_kg -= row.time_s < 12.0 ? 5.0 : 0.5;
    row.model->learned->p_BC_m[0] += 0.004;
    row.model->learned->p_BC_m[1] -= 0.003;
  });
  const ModelMetrics metrics = m.Finish();
  EXPECT_TRUE(metrics.present);
  ASSERT_EQ(metrics.intervals.size(), 2u);
  const ModelInterval& first = metrics.intervals[0];
  EXPECT_NEAR(first.duration_s, 10.0, 1e-9);
  EXPECT_EQ(first.step_kg, 0.0);
  EXPECT_EQ(first.settling_s, 0.0);
  EXPECT_TRUE(first.settled);
  const ModelInterval& loaded = metrics.intervals[1];
  EXPECT_NEAR(loaded.start_s, 10.0, 1e-9);
  EXPECT_EQ(loaded.mass_kg, 20.0);
  EXPECT_EQ(loaded.step_kg, 5.0);
  EXPECT_EQ(loaded.rows, 5000u);
  EXPECT_NEAR(loaded.bias_kg, 0.1, 1e-9);
  EXPECT_NEAR(loaded.rmse_kg, std::sqrt(0.05), 1e-9);
  EXPECT_NEAR(loaded.com_x_rmse_m, 0.004, 1e-12);
  EXPECT_NEAR(loaded.com_y_rmse_m, 0.003, 1e-12);
  EXPECT_NEAR(loaded.used_bias_kg, -0.5, 1e-9);
}

TEST(Model, SettlesWhenItWasLastOutsideTheMargin) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 5.0, Leave);
  work.row_.true_mass->mass_kg = 16.0;
  work.Run(m, 5.0, [](logs::Row& row) {
    const double since_s = row.time_s - 5.0;
    // Inside for a while in between: that is not settled.
    const bool outside = since_s < 0.4 || (since_s > 0.999 && since_s < 1.201);
    row.model->learned->mass_kg +=
        outside ? -0.26 : -0.24;  // the margin is 0.25 kg for steps up to 2.5 kg
  });
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_TRUE(metrics.intervals[1].settled);
  EXPECT_NEAR(metrics.intervals[1].settling_s, 1.2, 1e-9);
  EXPECT_NEAR(metrics.intervals[1].bias_kg, -0.24, 1e-9);
}

TEST(Model, MarginIsATenthOfALargeStep) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 1.0, Leave);
  work.row_.true_mass->mass_kg = 25.0;
  work.Run(m, 5.0, [](logs::Row& row) {
    row.model->learned->mass_kg += row.time_s < 1.999 ? -1.01 : -0.99;
  });
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_NEAR(metrics.intervals[1].settling_s, 1.0 - kRow_s, 1e-9);
  EXPECT_NEAR(metrics.intervals[1].rmse_kg, 0.99, 1e-9);
}

TEST(Model, NeverSettledCountsWithItsWholeDuration) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 2.0, Leave);
  work.row_.true_mass->mass_kg = 20.0;
  work.Run(m, 4.0, [](logs::Row& row) {
    row.model->learned->mass_kg = row.time_s > 4.0 && row.time_s < 5.0 ? 20.0 : kRobot_kg;
    row.model->used_mass_kg = kRobot_kg;
  });
  work.row_.true_mass->mass_kg = kRobot_kg;
  work.Run(m, 1.0, Leave);
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 3u);
  const ModelInterval& loaded = metrics.intervals[1];
  EXPECT_FALSE(loaded.settled);
  EXPECT_NEAR(loaded.settling_s, 4.0, 1e-9);
  EXPECT_EQ(loaded.bias_kg, 0.0);
  EXPECT_NEAR(loaded.used_bias_kg, -5.0, 1e-9);
}

TEST(Model, RemovalIsANegativeStep) {
  ModelAccumulator m;
  Work work;
  work.row_.true_mass->mass_kg = 20.0;
  work.Run(m, 2.0, Leave);
  work.row_.true_mass->mass_kg = kRobot_kg;
  work.Run(m, 4.0,
           [](logs::Row& row) { row.model->learned->mass_kg += row.time_s < 3.0 ? 5.0 : 0.4; });
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_EQ(metrics.intervals[1].step_kg, -5.0);
  EXPECT_TRUE(metrics.intervals[1].settled);
  EXPECT_NEAR(metrics.intervals[1].settling_s, 1.0 - kRow_s, 1e-9);
  EXPECT_NEAR(metrics.intervals[1].bias_kg, 0.4, 1e-9);
}

TEST(Model, LateBiasCountsWhetherSettledOrNot) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 5.0, Leave);
  work.row_.true_mass->mass_kg = 20.0;
  long i = 0;
  work.Run(m, 12.0, [&i](logs::Row& row) {
    row.model->learned->mass_kg += row.time_s < 14.999 ? 7.0 : (i++ % 2 == 0 ? -0.8 : -1.2);
    row.model->learned->p_BC_m[0] += 0.004;
    row.model->learned->p_BC_m[1] -= 0.003;
  });
  work.row_.true_mass->mass_kg = kRobot_kg;
  work.Run(m, 9.0, Leave);
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 3u);
  const ModelInterval& loaded = metrics.intervals[1];
  EXPECT_FALSE(loaded.settled);
  EXPECT_EQ(loaded.late_rows, 1000u);
  EXPECT_NEAR(loaded.late_bias_kg, -1.0, 1e-9);
  EXPECT_NEAR(loaded.late_noise_kg, 0.2, 1e-9);
  EXPECT_NEAR(loaded.late_com_x_bias_m, 0.004, 1e-12);
  EXPECT_NEAR(loaded.late_com_y_bias_m, -0.003, 1e-12);
  EXPECT_EQ(metrics.intervals[2].late_rows, 0u) << "too short";
}

/// Five kilograms over two seconds, in steps 20 ms apart, so that most rows look at rest.
TEST(Model, GradualChangeIsOneStepAndItsRowsBelongToNoInterval) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 3.0, Leave);
  const Work::Spoil late = [](logs::Row& row) {
    row.model->learned->mass_kg = row.time_s < 6.499 ? kRobot_kg : 20.1;
  };
  for (int step = 1; step <= 100; ++step) {
    work.row_.true_mass->mass_kg = kRobot_kg + 0.05 * step;
    work.Run(m, 0.02, late);
  }
  work.Run(m, 5.02, late);
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_NEAR(metrics.intervals[0].duration_s, 3.0, 1e-9);
  const ModelInterval& loaded = metrics.intervals[1];
  EXPECT_NEAR(loaded.start_s, 3.0 + 99 * 0.02, 1e-9);
  EXPECT_NEAR(loaded.step_kg, 5.0, 1e-9);
  EXPECT_NEAR(loaded.mass_kg, 20.0, 1e-9);
  EXPECT_NEAR(loaded.settling_s, 3.5 - kRow_s, 1e-9);  // from the change's first row
  EXPECT_NEAR(loaded.bias_kg, 0.1, 1e-9);
}

TEST(Model, ExchangeOfPayloadsIsOneStep) {
  ModelAccumulator m;
  Work work;
  work.row_.true_mass->mass_kg = 17.5;
  work.Run(m, 1.0, Leave);
  work.row_.true_mass->mass_kg = kRobot_kg;
  work.Run(m, kRow_s, Leave);
  work.row_.true_mass->mass_kg = 20.0;
  work.Run(m, 1.0, Leave);
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_EQ(metrics.intervals[1].step_kg, 2.5);
}

TEST(Model, FallenRowsAreLeftOutButTimeGoesOn) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 1.0, Leave);
  work.row_.true_mass->mass_kg = 20.0;
  work.Run(m, 6.0, [](logs::Row& row) {
    const double since_s = row.time_s - 1.0;
    row.episode->fallen = since_s > 1.999 && since_s < 2.999;
    row.episode->operating = !(since_s > 3.999 && since_s < 4.499);
    // The controller's fresh start after the fall has not taken its readings yet.
    row.model->learned->tared = !(since_s > 2.999 && since_s < 3.499);
    const bool wild = row.episode->fallen || !row.episode->operating || !row.model->learned->tared;
    row.model->learned->mass_kg += since_s < 1.0 ? -5.0 : (wild ? 9.0 : 0.2);
  });
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 2u);
  const ModelInterval& loaded = metrics.intervals[1];
  EXPECT_TRUE(loaded.settled);
  EXPECT_NEAR(loaded.settling_s, 1.0 - kRow_s, 2 * kRow_s);
  EXPECT_NEAR(loaded.bias_kg, 0.2, 1e-9);
  EXPECT_NEAR(loaded.duration_s, 6.0 - kRow_s, 1e-9);
  EXPECT_EQ(loaded.rows, 2000u);
}

TEST(Model, FirstIntervalBeginsWithTheTare) {
  ModelAccumulator m;
  Work work;
  work.row_.model->learned->tared = false;
  work.Run(m, 2.0, [](logs::Row& row) { row.episode->operating = row.time_s > 0.999; });
  work.row_.model->learned->tared = true;
  work.Run(m, 2.0, Leave);
  const ModelMetrics metrics = m.Finish();
  ASSERT_EQ(metrics.intervals.size(), 1u);
  EXPECT_NEAR(metrics.intervals[0].start_s, 2.0, 1e-9);
  EXPECT_EQ(metrics.intervals[0].rows, 1000u);
}

TEST(Model, WithoutAdaptationOnlyTheMassActedOnIsJudged) {
  ModelAccumulator m;
  Work work;
  const Work::Spoil none = [](logs::Row& row) {
    row.episode->operating = row.time_s > 0.999;
    row.model->learned.reset();
    row.model->used_mass_kg = kRobot_kg;
  };
  work.Run(m, 2.0, none);
  work.row_.true_mass->mass_kg = 17.0;
  work.Run(m, 1.0, none);
  const ModelMetrics metrics = m.Finish();
  EXPECT_FALSE(metrics.present);
  ASSERT_EQ(metrics.intervals.size(), 2u);
  EXPECT_NEAR(metrics.intervals[0].start_s, 1.0, 1e-9);
  EXPECT_EQ(metrics.intervals[1].rows, 0u);
  EXPECT_NEAR(metrics.intervals[1].used_bias_kg, -2.0, 1e-9);
  const ModelSummary s = SummariseModel(metrics.intervals);
  EXPECT_EQ(s.judged, 0);
  EXPECT_NEAR(s.median_used_bias_kg, 1.0, 1e-9);
}

TEST(Model, SummaryTakesMagnitudesOfSettledIntervals) {
  std::vector<ModelInterval> intervals;
  for (const double bias_kg : {-0.3, 0.1, -0.2}) {
    intervals.push_back({.duration_s = 9.0,
                         .settling_s = 1.0,
                         .settled = true,
                         .rows = 10,
                         .bias_kg = bias_kg,
                         .rmse_kg = 0.4});
  }
  intervals.push_back({.duration_s = 9.0, .settling_s = 9.0, .rows = 10});
  intervals.push_back({.duration_s = 9.0, .settling_s = 9.0});  // fallen all the time
  const ModelSummary s = SummariseModel(intervals);
  EXPECT_EQ(s.judged, 4);
  EXPECT_EQ(s.settled, 3);
  EXPECT_NEAR(s.median_bias_kg, 0.2, 1e-12);
  EXPECT_NEAR(s.p95_bias_kg, 0.29, 1e-12);
  EXPECT_NEAR(s.median_settling_s, 1.0, 1e-12);
}

TEST(Model, JsonRoundTripAndOlderResults) {
  ModelAccumulator m;
  Work work;
  work.Run(m, 1.0, Leave);
  work.row_.true_mass->mass_kg = 18.0;
  work.Run(m, 1.0, [](logs::Row& row) { row.model->learned->mass_kg += 0.05; });
  EpisodeMetrics episode;
  episode.model = m.Finish();
  nlohmann::json json = nlohmann::json::parse(nlohmann::json(episode).dump());
  EXPECT_EQ(json.get<EpisodeMetrics>().model, episode.model);
  for (nlohmann::json& i : json["model"]["intervals"]) i.erase("late_rows");
  EXPECT_EQ(json.get<EpisodeMetrics>().model, episode.model) << "results from before late values";
  json.erase("model");
  EXPECT_EQ(json.get<EpisodeMetrics>().model, ModelMetrics{});
}

}  // namespace
}  // namespace scoria::analysis
