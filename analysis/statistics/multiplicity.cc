// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/multiplicity.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scoria::analysis {
namespace {

/// Indices by rising p.
std::vector<std::size_t> Order(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  return order;
}

}  // namespace

std::vector<double> AdjustHolm(std::span<const double> p) {
  std::vector<double> adjusted(p.size());
  double largest = 0.0;
  double left = static_cast<double>(p.size());
  for (const std::size_t i : Order(p)) {
    largest = std::max(largest, std::min(1.0, left * p[i]));
    adjusted[i] = largest;
    left -= 1.0;
  }
  return adjusted;
}

std::vector<double> AdjustFalseDiscovery(std::span<const double> p) {
  std::vector<double> adjusted(p.size());
  const std::vector<std::size_t> order = Order(p);
  double smallest = 1.0;
  for (std::size_t rank = p.size(); rank > 0; --rank) {
    const std::size_t i = order[rank - 1];
    smallest = std::min(smallest, p[i] * static_cast<double>(p.size()) / static_cast<double>(rank));
    adjusted[i] = smallest;
  }
  return adjusted;
}

}  // namespace scoria::analysis
