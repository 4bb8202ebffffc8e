// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/resample.h"

#include <algorithm>
#include <cmath>

namespace scoria::terrains {
namespace {

/// Catmull-Rom kernel. Source: Keys 1981, a = -1/2.
double Kernel(double x) {
  x = std::abs(x);
  if (x < 1.0) return (1.5 * x - 2.5) * x * x + 1.0;
  if (x < 2.0) return ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0;
  return 0.0;
}

/// What one new node takes of the old cells along an axis.
struct Taps {
  int first = 0;
  std::vector<double> weights;
};

/// @param start  place of the first new node, in old cells from the first old centre.
/// @param step  new spacing in old cells.
std::vector<Taps> MakeTaps(int nodes, double start, double step) {
  std::vector<Taps> all(static_cast<std::size_t>(nodes));
  const double stretch = std::max(1.0, step), reach = 2.0 * stretch;
  for (int i = 0; i < nodes; ++i) {
    Taps& taps = all[static_cast<std::size_t>(i)];
    const double at = start + step * i;
    taps.first = static_cast<int>(std::ceil(at - reach));
    double sum = 0.0;
    for (int cell = taps.first; cell <= at + reach; ++cell) {
      taps.weights.push_back(Kernel((cell - at) / stretch));
      sum += taps.weights.back();
    }
    for (double& weight : taps.weights) weight /= sum;
  }
  return all;
}

/// The weighted sum of value(cell), cells beyond the ends being the last ones.
template <class Value>
double Apply(const Taps& taps, int cells, Value value) {
  double sum = 0.0;
  int cell = taps.first;
  for (const double weight : taps.weights) sum += weight * value(std::clamp(cell++, 0, cells - 1));
  return sum;
}

/// First node and step along an axis of `cells` old cells, in old cells.
std::vector<Taps> AxisTaps(int nodes, int cells, double ratio) {
  return MakeTaps(nodes, 0.5 * (cells - 1) - 0.5 * (nodes - 1) * ratio, ratio);
}

}  // namespace

Grid Resample(const HeightTable& table, const TileWindow& window, int nodes, double spacing_m) {
  const std::vector<Taps> east = AxisTaps(nodes, window.columns, spacing_m / table.dx_m);
  const std::vector<Taps> south = AxisTaps(nodes, window.rows, spacing_m / table.dy_m);
  // Along the rows first: `wide` has the new columns and the old rows.
  const auto n = static_cast<std::size_t>(nodes);
  std::vector<double> wide(n * static_cast<std::size_t>(window.rows));
  for (int row = 0; row < window.rows; ++row) {
    for (std::size_t column = 0; column < n; ++column) {
      wide[static_cast<std::size_t>(row) * n + column] = Apply(
          east[column], window.columns,
          [&](int cell) { return table.at(window.first_column + cell, window.first_row + row); });
    }
  }
  Grid heights(nodes, spacing_m);
  for (int row = 0; row < nodes; ++row) {
    const Taps& taps = south[static_cast<std::size_t>(nodes - 1 - row)];  // our rows go north
    for (std::size_t column = 0; column < n; ++column) {
      heights.at(static_cast<int>(column), row) = Apply(taps, window.rows, [&](int cell) {
        return wide[static_cast<std::size_t>(cell) * n + column];
      });
    }
  }
  return heights;
}

}  // namespace scoria::terrains
