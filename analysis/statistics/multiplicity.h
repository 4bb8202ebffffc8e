// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace scoria::analysis {

/// p-values of a family of tests, adjusted: where one is at most α the test rejects, and the
/// probability of any false rejection in the family is at most α, whatever their dependence.
/// @param p  in [0, 1]. @returns in the same order. Source: [Holm1979].
[[nodiscard]] std::vector<double> AdjustHolm(std::span<const double> p);

/// Likewise, but the expected share of false ones among the rejections is at most α (false
/// discovery rate), for tests that are independent or positively dependent.
/// Source: [Benjamini1995].
[[nodiscard]] std::vector<double> AdjustFalseDiscovery(std::span<const double> p);

}  // namespace scoria::analysis
