// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sobol_indices.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

using Function = std::function<double(const UnitPoint& u)>;

std::vector<SobolIndices> IndicesOf(const Function& f, std::size_t factors,
                                    const std::vector<UnitPoint>& sample) {
  std::vector<double> responses;
  for (const UnitPoint& point : SensitivityPoints(sample)) responses.push_back(f(point));
  return EstimateSobolIndices(responses, factors, 1);
}

/// Source: Ishigami, Homma, ISUMA 1990.
double Ishigami(const UnitPoint& u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
         0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

void ExpectIshigami(const std::vector<SobolIndices>& indices, double tolerance_of_first) {
  const double first[] = {0.3139, 0.4424, 0.0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(indices[k].first, first[k], tolerance_of_first);
    EXPECT_NEAR(indices[k].total, total[k], 0.05 * total[k]);
    EXPECT_TRUE(indices[k].total_interval.Contains(total[k])) << k;
  }
}

TEST(SobolIndices, OfIshigamisFunction) {
  ExpectIshigami(IndicesOf(Ishigami, 3, SampleSobol(4096, 6, 1)), 0.015);
  ExpectIshigami(IndicesOf(Ishigami, 3, SampleLatinHypercube(8192, 6, 2)), 0.04);
}

// Sobol's g-function, whose indices are known in closed form.
TEST(SobolIndices, OfTheGFunction) {
  const std::vector<double> a = {0.0, 1.0, 4.5, 9.0};
  const Function g = [&](const UnitPoint& u) {
    double product = 1.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      product *= (std::abs(4.0 * u[i] - 2.0) + a[i]) / (1.0 + a[i]);
    return product;
  };
  double all = 1.0;
  for (const double x : a) all *= 1.0 + 1.0 / (3.0 * (1.0 + x) * (1.0 + x));
  const auto indices = IndicesOf(g, a.size(), SampleSobol(8192, 2 * a.size(), 3));
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double v = 1.0 / (3.0 * (1.0 + a[k]) * (1.0 + a[k]));
    EXPECT_NEAR(indices[k].total, v * all / (1.0 + v) / (all - 1.0),
                0.05 * v * all / (1.0 + v) / (all - 1.0));
    EXPECT_NEAR(indices[k].first, v / (all - 1.0), 0.05 * std::max(v / (all - 1.0), 0.05));
  }
}

TEST(SobolIndices, SayNothingOfWhatDoesNotVary) {
  const auto constant = IndicesOf([](const UnitPoint&) { return 1.0; }, 2, SampleSobol(8, 4, 1));
  EXPECT_TRUE(std::isnan(constant[0].total));
  EXPECT_TRUE(std::isnan(constant[0].total_interval.low));
  const auto few = IndicesOf([](const UnitPoint& u) { return u[0]; }, 2, SampleSobol(4, 4, 1));
  EXPECT_TRUE(std::isnan(few[0].total_interval.low)) << "of four rows";
  EXPECT_EQ(few[1].total, 0.0);
}

TEST(Sampling, LatinHypercubeHasOnePointInEachInterval) {
  const auto sample = SampleLatinHypercube(50, 3, 4);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<int> counts(50);
    for (const UnitPoint& p : sample) ++counts[static_cast<std::size_t>(50.0 * p[k])];
    EXPECT_EQ(counts, std::vector<int>(50, 1));
  }
  EXPECT_NE(sample, SampleLatinHypercube(50, 3, 5));
  EXPECT_EQ(sample, SampleLatinHypercube(50, 3, 4));
}

// A net: of 64 points in two dimensions one lies in each of the 64 rectangles of any shape of
// powers of two.
TEST(Sampling, SobolsPointsAreANet) {
  const auto sample = SampleSobol(64, 2, 6);
  for (const int columns : {1, 2, 4, 8, 16, 32, 64}) {
    const int rows = 64 / columns;
    std::vector<int> counts(64);
    for (const UnitPoint& p : sample)
      ++counts[static_cast<std::size_t>(static_cast<int>(columns * p[0]) * rows +
                                        static_cast<int>(rows * p[1]))];
    EXPECT_EQ(counts, std::vector<int>(64, 1)) << columns;
  }
  EXPECT_NE(sample, SampleSobol(64, 2, 7));
}

}  // namespace
}  // namespace scoria::analysis
