// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "analysis/statistics/sequential_sign_test.h"
#include "analysis/statistics/sequential_t_test.h"
#include "tests/analysis/statistics/gamma.h"

namespace scoria::analysis {
namespace {

using Draw = std::function<double(core::Rng&)>;

/// In how many of 1000 sequences of pairs a test rejects at 5 % at any time.
template <class Test>
int CountRejections(std::uint64_t first_seed, int pairs, const Draw& draw,
                    Alternative alternative = Alternative::kTwoSided) {
  int rejections = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    core::Rng rng(first_seed + i, 0, core::Stream::kOperator);
    Test test(alternative);
    for (int k = 0; k < pairs && !test.evidence().Rejects(0.05); ++k) test.Add(draw(rng));
    if (test.evidence().Rejects(0.05)) ++rejections;
  }
  return rejections;
}

double Normal(core::Rng& rng) { return rng.NextNormal(); }
/// Student's t with three degrees of freedom.
double HeavyTailed(core::Rng& rng) {
  const double x = rng.NextNormal(), a = rng.NextNormal(), b = rng.NextNormal(),
               c = rng.NextNormal();
  return x / std::sqrt((a * a + b * b + c * c) / 3.0);
}
double Level(core::Rng& rng) { return rng.NextUniform() < 0.5 ? -1.0 : 1.0; }
/// Falls of two arms on a terrain that treats them differently.
double OverDispersed(core::Rng& rng) {
  const int a = rng.NextPoisson(2.0 * test::DrawGamma(rng, 1));
  return a - rng.NextPoisson(2.0 * test::DrawGamma(rng, 1));
}

// A against A, looking after every pair. Differences of any symmetric distribution.
TEST(SequentialSignTest, SeldomRejectsWhatIsSymmetric) {
  for (const Draw& draw : {Draw(Normal), Draw(HeavyTailed), Draw(Level), Draw(OverDispersed)}) {
    for (const Alternative side : {Alternative::kTwoSided, Alternative::kGreater}) {
      EXPECT_LE(CountRejections<SequentialSignTest>(1, 200, draw, side), 66);
      EXPECT_LE(CountRejections<SequentialSignTest>(5000, 12, draw, side), 66);
    }
  }
}

TEST(SequentialTTest, SeldomRejectsNormalDifferencesWithoutMean) {
  for (const Alternative side : {Alternative::kTwoSided, Alternative::kLess}) {
    EXPECT_LE(CountRejections<SequentialTTest>(1, 200, Normal, side), 66);
    EXPECT_LE(CountRejections<SequentialTTest>(5000, 12, Normal, side), 66);
    EXPECT_LE(CountRejections<SequentialTTest>(9000, 100, HeavyTailed, side), 66);
  }
  EXPECT_GT(CountRejections<SequentialTTest>(1, 12, Level), 66) << "values of few levels";
}

// What the sequential tests are for: the usual test, looked at after every pair, rejects far too
// often.
TEST(SequentialTTest, IsNeededWhereOneLooksOften) {
  int rejections = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    core::Rng rng(i, 0, core::Stream::kOperator);
    double sum = 0.0;
    bool rejected = false;
    for (int n = 1; n <= 200; ++n) {
      sum += rng.NextNormal();
      rejected = rejected || std::abs(sum) / std::sqrt(n) > 1.96;  // z-test, variance known
    }
    if (rejected) ++rejections;
  }
  EXPECT_GT(rejections, 250);
}

// By hand: all signs alike, equal sizes. Each factor is exp(κ) / cosh(κ).
TEST(SequentialSignTest, MultipliesItsFactors) {
  SequentialSignTest test(Alternative::kGreater);
  for (int i = 0; i < 7; ++i) test.Add(3.0);
  double mean = 0.0;
  for (const double slope : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0})
    mean += std::pow(std::exp(slope) / std::cosh(slope), 7) / 6.0;
  EXPECT_NEAR(test.evidence().log_e(), std::log(mean), 1e-12);
  EXPECT_LT(mean, std::pow(2.0, 7)) << "a sign says no more than a bit";
  const double p = test.evidence().p_value();
  EXPECT_NEAR(p, 1.0 / mean, 1e-12);
  test.Add(-30.0);
  EXPECT_LT(test.evidence().log_e(), std::log(mean));
  EXPECT_EQ(test.evidence().p_value(), p) << "of the largest E so far";
}

/// E_g by integrating the likelihood over σ (right Haar) and the effect over its prior, by sums.
double BayesFactor(const std::vector<double>& x, double g, bool one_sided) {
  double squares = 0.0, sum = 0.0;
  for (const double v : x) {
    squares += v * v;
    sum += v;
  }
  const double n = static_cast<double>(x.size());
  double alternative = 0.0, null = 0.0;
  constexpr double kLogStep = 0.01, kStep = 0.01;
  for (double log_sigma = -6.0; log_sigma < 6.0; log_sigma += kLogStep) {
    const double sigma = std::exp(log_sigma);
    const auto likelihood = [&](double effect) {
      const double mean = effect * sigma;
      return std::pow(sigma, -n) *
             std::exp(-(squares - 2.0 * mean * sum + n * mean * mean) / (2.0 * sigma * sigma));
    };
    null += likelihood(0.0) * kLogStep;
    for (double effect = one_sided ? 0.5 * kStep : -12.0; effect < 12.0; effect += kStep) {
      const double prior = std::exp(-effect * effect / (2.0 * g)) / std::sqrt(2.0 * M_PI * g) *
                           (one_sided ? 2.0 : 1.0);
      alternative += prior * likelihood(effect) * kStep * kLogStep;
    }
  }
  return alternative / null;
}

TEST(SequentialTTest, IsTheBayesFactorOfItsPrior) {
  const std::vector<double> x = {0.8, 1.9, -0.3, 1.2};
  for (const bool one_sided : {false, true}) {
    SequentialTTest test(one_sided ? Alternative::kGreater : Alternative::kTwoSided);
    for (const double v : x) test.Add(v);
    double mean = 0.0;
    for (const double g : {0.25, 1.0, 4.0, 16.0}) mean += BayesFactor(x, g, one_sided) / 4.0;
    // σ and effect are cut off, and summed in steps of 0.01; four standard deviations of the widest
    // prior hold all but 3 in 1000 of it.
    EXPECT_NEAR(std::exp(test.evidence().log_e()) / mean, 1.0, 0.01);
  }
}

TEST(SequentialTTest, NeedsFewPairsForALargeEffect) {
  SequentialTTest t(Alternative::kGreater);
  SequentialSignTest sign(Alternative::kGreater);
  int pairs = 0;
  for (; !t.evidence().Rejects(0.001); ++pairs) {
    const double difference = 5.0 + (pairs % 2 == 0 ? 1.0 : -1.0);
    t.Add(difference);
    sign.Add(difference);
  }
  EXPECT_LE(pairs, 7);
  EXPECT_FALSE(sign.evidence().Rejects(0.001)) << "ten pairs are its least";
}

TEST(SequentialTests, AreOfOneSide) {
  SequentialTTest t(Alternative::kLess);
  SequentialSignTest sign(Alternative::kLess);
  for (int i = 0; i < 20; ++i) {
    t.Add(1.0 + 0.1 * (i % 3));
    sign.Add(1.0 + 0.1 * (i % 3));
  }
  for (const EProcess& e : {t.evidence(), sign.evidence()}) {
    EXPECT_LT(e.log_e(), -1.0);
    EXPECT_EQ(e.p_value(), 1.0);
  }
}

}  // namespace
}  // namespace scoria::analysis
