// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace scoria::app {
namespace {

struct Cell {
  int column = 0, row = 0;
};

/// Half extents of the stance about the trunk, m.
struct Stance {
  double length_m = 0.0, width_m = 0.0;
};

Stance StanceOf(const core::RobotDescription& robot) {
  Stance stance;
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = robot.NeutralFoothold(leg);
    stance.length_m = std::max(stance.length_m, std::abs(p_BF.x()));
    stance.width_m = std::max(stance.width_m, std::abs(p_BF.y()));
  }
  return stance;
}

/// What a metre costs on each cell of a square grid over the tile.
class CostMap {
 public:
  static constexpr double kCell_m = 0.1;

  CostMap(const RouteParams& params, const core::RobotDescription& robot,
          const terrains::Heightfield& ground)
      : half_m_(ground.half_size_m()), size_(static_cast<int>(2.0 * half_m_ / kCell_m)) {
    const Stance stance = StanceOf(robot);
    cost_.resize(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
    for (int row = 0; row < size_; ++row) {
      for (int column = 0; column < size_; ++column) {
        const double effort = Effort(params, stance, ground, Centre({column, row}));
        cost_[Index({column, row})] = 1.0 + 9.0 * effort * effort;
      }
    }
    Widen(stance.width_m + kFootRoom_m);
  }

  [[nodiscard]] double Cost(Cell c) const { return cost_[Index(c)]; }
  [[nodiscard]] std::size_t cells() const { return cost_.size(); }
  [[nodiscard]] bool Contains(Cell c) const {
    return c.column >= 0 && c.row >= 0 && c.column < size_ && c.row < size_;
  }
  [[nodiscard]] std::size_t Index(Cell c) const {
    return static_cast<std::size_t>(c.row) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(c.column);
  }
  [[nodiscard]] Cell CellAt(std::size_t index) const {
    const auto size = static_cast<std::size_t>(size_);
    return {static_cast<int>(index % size), static_cast<int>(index / size)};
  }
  [[nodiscard]] Vec2 Centre(Cell c) const {
    return {(c.column + 0.5) * kCell_m - half_m_, (c.row + 0.5) * kCell_m - half_m_};
  }
  [[nodiscard]] Cell CellOf(const Vec2& p_W) const {
    const auto cell = [&](double x) {
      return std::clamp(static_cast<int>((x + half_m_) / kCell_m), 0, size_ - 1);
    };
    return {cell(p_W.x()), cell(p_W.y())};
  }

 private:
  static constexpr double kFootRoom_m = 0.05;  // a foot never lands just where it is meant to

  /// (step / max_step)² + (slope / max_slope)²: 1 at one limit.
  static double Effort(const RouteParams& params, const Stance& stance,
                       const terrains::Heightfield& ground, const Vec2& p_W) {
    constexpr int kProbes = 5;
    constexpr double kStepSpan_m = 0.2;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < kProbes; ++i) {
      for (int j = 0; j < kProbes; ++j) {
        const double z = ground.HeightAt(p_W.x() + kStepSpan_m * (i / (kProbes - 1.0) - 0.5),
                                         p_W.y() + kStepSpan_m * (j / (kProbes - 1.0) - 0.5));
        low = std::min(low, z);
        high = std::max(high, z);
      }
    }
    const double arm_m = 2.0 * stance.length_m;
    const auto gradient = [&](double dx, double dy) {
      return (ground.HeightAt(p_W.x() + dx, p_W.y() + dy) -
              ground.HeightAt(p_W.x() - dx, p_W.y() - dy)) /
             (2.0 * arm_m);
    };
    const double slope = std::hypot(gradient(arm_m, 0.0), gradient(0.0, arm_m));
    const double by_step = (high - low) / params.max_step_m;
    const double by_slope = slope / std::tan(params.max_slope_rad);
    return by_step * by_step + by_slope * by_slope;
  }

  /// Each cell takes the worst cost within the corridor's half width.
  void Widen(double half_width_m) {
    const int reach = static_cast<int>(std::lround(half_width_m / kCell_m));
    std::vector<double> worst = cost_;
    for (int row = 0; row < size_; ++row) {
      for (int column = 0; column < size_; ++column) {
        double& cost = worst[Index({column, row})];
        for (int dr = -reach; dr <= reach; ++dr) {
          for (int dc = -reach; dc <= reach; ++dc) {
            const Cell other{column + dc, row + dr};
            if (dr * dr + dc * dc > reach * reach || !Contains(other)) continue;
            cost = std::max(cost, cost_[Index(other)]);
          }
        }
      }
    }
    cost_ = std::move(worst);
  }

  double half_m_;
  int size_;
  std::vector<double> cost_;
};

constexpr double kRounding = 1e-9;  // of sums of costs

/// Cheapest 8-connected path between two cells; `from` included, `to` not.
std::vector<Cell> FindPath(const CostMap& map, Cell from, Cell to) {
  std::vector<double> best(map.cells(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> parent(map.cells());
  // At least the distance; of paths that cost the same, those near the straight line come first.
  const auto estimate = [&](Cell c) {
    constexpr double kTieBreak = 1e-4;
    const double across = (c.column - to.column) * static_cast<double>(from.row - to.row) -
                          (c.row - to.row) * static_cast<double>(from.column - to.column);
    return std::hypot(c.column - to.column, c.row - to.row) + kTieBreak * std::abs(across);
  };
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::size_t start = map.Index(from), goal = map.Index(to);
  best[start] = 0.0;
  open.emplace(estimate(from), start);
  while (!open.empty()) {
    const auto [priority, index] = open.top();
    open.pop();
    if (index == goal) break;
    const Cell c = map.CellAt(index);
    if (priority > best[index] + estimate(c) + kRounding) continue;  // an older, longer way
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const Cell next{c.column + dc, c.row + dr};
        if ((dr == 0 && dc == 0) || !map.Contains(next)) continue;
        const double cost = best[index] + std::hypot(dc, dr) * 0.5 * (map.Cost(c) + map.Cost(next));
        const std::size_t n = map.Index(next);
        if (cost >= best[n] - kRounding) continue;
        best[n] = cost;
        parent[n] = index;
        open.emplace(cost + estimate(next), n);
      }
    }
  }
  std::vector<Cell> path;
  for (std::size_t index = goal; index != start;) {
    index = parent[index];
    path.push_back(map.CellAt(index));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// The cheapest cell near a place, the nearest of equals: a person leads over good ground near the
/// circle, not through each of its points.
Cell BestCellNear(const CostMap& map, const Vec2& p_W, double radius_m) {
  const Cell centre = map.CellOf(p_W);
  const int reach = static_cast<int>(radius_m / CostMap::kCell_m);
  Cell best = centre;
  const auto price = [&](Cell c) {
    const double away = std::hypot(c.column - centre.column, c.row - centre.row) / reach;
    return map.Cost(c) * (1.0 + away);
  };
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell c{centre.column + dc, centre.row + dr};
      if (map.Contains(c) && price(c) < price(best)) best = c;
    }
  }
  return best;
}

}  // namespace

Route PlanRoute(const RouteParams& params, const core::RobotDescription& robot,
                const terrains::Heightfield& ground) {
  constexpr int kCorners = 8;
  constexpr double kMargin_m = 2.0, kSmallestLoop_m = 0.5, kCornerRoomShare = 0.2, kEdge_m = 1.0;
  const double radius_m = std::min(params.loop_radius_m, ground.half_size_m() - kMargin_m);
  if (radius_m < kSmallestLoop_m) {
    throw core::ConfigError(
        {}, "terrain",
        fmt::format("is {:.1f} m wide; a route needs at least {} m", 2.0 * ground.half_size_m(),
                    2.0 * (kMargin_m + kSmallestLoop_m)));
  }
  const CostMap map(params, robot, ground);
  const double corner_room_m =
      std::min(kCornerRoomShare * radius_m, ground.half_size_m() - radius_m - kEdge_m);
  std::array<Cell, kCorners> corners;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kCorners;
    corners[i] =
        BestCellNear(map, radius_m * Vec2(std::cos(angle), std::sin(angle)), corner_room_m);
  }
  Route route;
  for (std::size_t i = 0; i < kCorners; ++i) {
    for (const Cell c : FindPath(map, corners[i], corners[(i + 1) % kCorners]))
      route.push_back(map.Centre(c));
  }
  return route;
}

}  // namespace scoria::app
