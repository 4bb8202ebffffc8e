// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/multiplicity.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

long CountBelow(const std::vector<double>& p, double alpha) {
  return std::count_if(p.begin(), p.end(), [&](double x) { return x <= alpha; });
}

// The fifteen p-values of [Benjamini1995], section 3.2, of which Bonferroni's procedure rejects
// three and theirs four.
TEST(Multiplicity, IsThatOfAPublishedExample) {
  std::vector<double> p = {0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                           0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  EXPECT_EQ(CountBelow(AdjustHolm(p), 0.05), 3);
  EXPECT_EQ(CountBelow(AdjustFalseDiscovery(p), 0.05), 4);
  EXPECT_NEAR(AdjustHolm(p)[3], 12 * 0.0095, 1e-12);
  EXPECT_NEAR(AdjustFalseDiscovery(p)[3], 15 * 0.0095 / 4, 1e-12);
  std::reverse(p.begin(), p.end());
  EXPECT_NEAR(AdjustHolm(p)[14], 15 * 0.0001, 1e-12) << "in the order of the tests";
}

TEST(Multiplicity, AdjustedValuesRiseAndStayWithinOne) {
  const std::vector<double> p = {0.02, 0.03, 0.021};
  const std::vector<double> holm = AdjustHolm(p), rate = AdjustFalseDiscovery(p);
  EXPECT_NEAR(holm[0], 0.06, 1e-12);
  EXPECT_NEAR(holm[2], 0.06, 1e-12) << "not below the one before";
  EXPECT_NEAR(holm[1], 0.06, 1e-12);
  for (const double q : rate) EXPECT_NEAR(q, 0.03, 1e-12) << "not above the one after";
  EXPECT_EQ(AdjustHolm(std::vector<double>{0.9, 0.8})[0], 1.0);
  EXPECT_TRUE(AdjustHolm({}).empty());
}

// Families of twenty tests without any effect: one in twenty has a false rejection, where
// uncorrected two in three have.
TEST(Multiplicity, HolmKeepsTheFamilysLevel) {
  int corrected = 0, uncorrected = 0;
  core::Rng rng(1, 0, core::Stream::kOperator);
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> p(20);
    for (double& x : p) x = rng.NextUniform();
    if (CountBelow(AdjustHolm(p), 0.05) > 0) ++corrected;
    if (CountBelow(p, 0.05) > 0) ++uncorrected;
  }
  EXPECT_LE(corrected, 66);
  EXPECT_GT(uncorrected, 600);
}

}  // namespace
}  // namespace scoria::analysis
