// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/grid.h"

#include <cstdint>

namespace scoria::terrains {

Grid BoxBlur(const Grid& in, int radius) {
  Grid once(in.nodes, in.spacing_m), out(in.nodes, in.spacing_m);
  const auto run = [&](auto get, auto set) {
    double sum = 0.0;
    const auto value = [&](int i) { return get(std::clamp(i, 0, in.nodes - 1)); };
    for (int i = -radius; i <= radius; ++i) sum += value(i);
    for (int i = 0; i < in.nodes; ++i) {
      set(i, sum / (2 * radius + 1));
      sum += value(i + radius + 1) - value(i - radius);
    }
  };
  for (int r = 0; r < in.nodes; ++r) {
    run([&](int i) { return in.at(i, r); }, [&](int i, double v) { once.at(i, r) = v; });
  }
  for (int c = 0; c < in.nodes; ++c) {
    run([&](int i) { return once.at(c, i); }, [&](int i, double v) { out.at(c, i) = v; });
  }
  return out;
}

Vec2 FitPlane(const Grid& heights) {
  Vec2 moment = Vec2::Zero(), size = Vec2::Zero();  // nodes are symmetric about the origin
  constexpr int kStride = 4;
  const auto weigh = [&](int column, int row) {
    const Vec2 p = heights.Position(column, row);
    moment += p * heights.at(column, row);
    size += p.cwiseAbs2();
  };
  for (int row = 0; 2 * row < heights.nodes; row += kStride) {
    for (int column = 0; 2 * column < heights.nodes; column += kStride) {
      const int far_row = heights.nodes - 1 - row, far_column = heights.nodes - 1 - column;
      weigh(column, row), weigh(far_column, row), weigh(column, far_row);
      weigh(far_column, far_row);
    }
  }
  return moment.cwiseQuotient(size);
}

double CalcDeviation(const Grid& heights, double lag_m, const Vec2& plane) {
  constexpr int kStride = 3;  // every third node: the estimate is converged, the time is a ninth
  const int lag = std::max(1, static_cast<int>(std::lround(lag_m / heights.spacing_m)));
  const Vec2 drop = plane * (lag * heights.spacing_m);
  double sum = 0.0;
  std::int64_t count = 0;
  for (int r = 0; r + lag < heights.nodes; r += kStride) {
    for (int c = 0; c + lag < heights.nodes; c += kStride) {
      const double z = heights.at(c, r);
      const double east = heights.at(c + lag, r) - z - drop.x();
      const double north = heights.at(c, r + lag) - z - drop.y();
      sum += east * east + north * north;
      count += 2;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace scoria::terrains
