// SPDX-License-Identifier: BSD-3-Clause
#include "app/operator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "core/math/so3.h"

namespace scoria::app {
namespace {

constexpr double kPi = std::numbers::pi;

/// Cost of crossing each 0.2 m cell: 1, or kDetour where a person would not lead the robot.
class CostMap {
 public:
  static constexpr double kCell_m = 0.2;
  static constexpr double kDetour = 20.0;

  CostMap(const RouteParams& params, const terrains::Heightfield& ground)
      : half_m_(ground.half_size_m()), size_(static_cast<int>(2.0 * half_m_ / kCell_m)) {
    std::vector<bool> bad(static_cast<std::size_t>(size_ * size_));
    for (int row = 0; row < size_; ++row) {
      for (int column = 0; column < size_; ++column)
        bad[Index(column, row)] = IsBad(params, ground, column, row);
    }
    constexpr int kCorridor = 2;  // cells on either side: the robot is 0.4 m wide with its legs
    cost_.assign(bad.size(), 1.0);
    for (int row = 0; row < size_; ++row) {
      for (int column = 0; column < size_; ++column) {
        if (!bad[Index(column, row)]) continue;
        for (int r = std::max(0, row - kCorridor); r <= std::min(size_ - 1, row + kCorridor); ++r) {
          for (int c = std::max(0, column - kCorridor);
               c <= std::min(size_ - 1, column + kCorridor); ++c) {
            cost_[Index(c, r)] = kDetour;
          }
        }
      }
    }
  }

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] double Cost(int column, int row) const { return cost_[Index(column, row)]; }
  [[nodiscard]] std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row * size_ + column);
  }
  [[nodiscard]] Vec2 Centre(int column, int row) const {
    return {(column + 0.5) * kCell_m - half_m_, (row + 0.5) * kCell_m - half_m_};
  }
  [[nodiscard]] std::array<int, 2> CellOf(const Vec2& p) const {
    const auto cell = [&](double x) {
      return std::clamp(static_cast<int>((x + half_m_) / kCell_m), 0, size_ - 1);
    };
    return {cell(p.x()), cell(p.y())};
  }

 private:
  bool IsBad(const RouteParams& params, const terrains::Heightfield& ground, int column,
             int row) const {
    const Vec2 p = Centre(column, row);
    constexpr int kProbes = 5;
    double low = 1e30, high = -1e30;
    for (int i = 0; i < kProbes; ++i) {
      for (int j = 0; j < kProbes; ++j) {
        const double z = ground.HeightAt(p.x() + kCell_m * (i / (kProbes - 1.0) - 0.5),
                                         p.y() + kCell_m * (j / (kProbes - 1.0) - 0.5));
        low = std::min(low, z);
        high = std::max(high, z);
      }
    }
    constexpr double kArm_m = 0.4;  // slope over the robot's own length
    const double gx =
        (ground.HeightAt(p.x() + kArm_m, p.y()) - ground.HeightAt(p.x() - kArm_m, p.y())) /
        (2 * kArm_m);
    const double gy =
        (ground.HeightAt(p.x(), p.y() + kArm_m) - ground.HeightAt(p.x(), p.y() - kArm_m)) /
        (2 * kArm_m);
    return high - low > params.max_step_m || std::atan(std::hypot(gx, gy)) > params.max_slope_rad;
  }

  double half_m_;
  int size_;
  std::vector<double> cost_;
};

/// Cheapest 8-connected path between two cells, both ends included.
std::vector<std::array<int, 2>> FindPath(const CostMap& map, std::array<int, 2> from,
                                         std::array<int, 2> to) {
  const auto count = static_cast<std::size_t>(map.size() * map.size());
  std::vector<double> best(count, std::numeric_limits<double>::infinity());
  std::vector<int> parent(count, -1);
  const auto estimate = [&](int c, int r) { return std::hypot(c - to[0], r - to[1]); };
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const int start = from[1] * map.size() + from[0], goal = to[1] * map.size() + to[0];
  best[static_cast<std::size_t>(start)] = 0.0;
  open.emplace(estimate(from[0], from[1]), start);
  while (!open.empty()) {
    const auto [priority, cell] = open.top();
    open.pop();
    if (cell == goal) break;
    const int c = cell % map.size(), r = cell / map.size();
    const double so_far = best[static_cast<std::size_t>(cell)];
    if (priority > so_far + estimate(c, r) + 1e-9) continue;  // an older, longer way
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const int nc = c + dc, nr = r + dr;
        if ((dr == 0 && dc == 0) || nc < 0 || nr < 0 || nc >= map.size() || nr >= map.size())
          continue;
        const double cost = so_far + std::hypot(dc, dr) * 0.5 * (map.Cost(c, r) + map.Cost(nc, nr));
        const std::size_t next = map.Index(nc, nr);
        if (cost >= best[next]) continue;
        best[next] = cost;
        parent[next] = cell;
        open.emplace(cost + estimate(nc, nr), static_cast<int>(next));
      }
    }
  }
  std::vector<std::array<int, 2>> path;
  for (int cell = goal; cell >= 0; cell = parent[static_cast<std::size_t>(cell)]) {
    path.push_back({cell % map.size(), cell / map.size()});
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

Route PlanRoute(const RouteParams& params, const terrains::Heightfield& ground) {
  constexpr int kCorners = 8;
  constexpr double kMargin_m = 2.0, kSmallestLoop_m = 0.5;
  const double radius_m = std::min(params.loop_radius_m, ground.half_size_m() - kMargin_m);
  if (radius_m < kSmallestLoop_m) {
    throw core::ConfigError(
        {}, "terrain",
        fmt::format("is {:.1f} m wide; a route needs at least {} m", 2.0 * ground.half_size_m(),
                    2.0 * (kMargin_m + kSmallestLoop_m)));
  }
  const CostMap map(params, ground);
  Route route;
  for (int i = 0; i < kCorners; ++i) {
    const auto corner = [&](int k) {
      const double angle = 2.0 * kPi * (k % kCorners) / kCorners;
      return map.CellOf(radius_m * Vec2(std::cos(angle), std::sin(angle)));
    };
    const auto path = FindPath(map, corner(i), corner(i + 1));
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      route.push_back(map.Centre(path[k][0], path[k][1]));
  }
  return route;
}

Operator::Operator(const OperatorParams& params, const terrains::Heightfield& ground)
    : params_(params) {
  if (const auto* route = std::get_if<RouteParams>(&params)) route_ = PlanRoute(*route, ground);
}

Vec2 Operator::start_W() const noexcept { return route_.empty() ? Vec2::Zero() : route_.front(); }

double Operator::start_yaw_rad() const noexcept {
  return route_.empty() ? 0.0 : HeadingAt(route_.front());
}

double Operator::HeadingAt(const Vec2& p_W) const noexcept {
  if (route_.empty()) return 0.0;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < route_.size(); ++i) {
    if ((route_[i] - p_W).squaredNorm() < (route_[nearest] - p_W).squaredNorm()) nearest = i;
  }
  constexpr std::size_t kAhead = 5;
  const Vec2 along = route_[(nearest + kAhead) % route_.size()] - route_[nearest];
  return std::atan2(along.y(), along.x());
}

/// Pure pursuit: heads for the route point one look-ahead in front.
Command Operator::FollowRoute(const RouteParams& params, const RobotState& state,
                              double dt_s) noexcept {
  const Vec2 p = state.p_WB.head<2>();
  // Only a window ahead is searched, so that a loop that passes near itself is not cut short.
  constexpr std::size_t kWindow = 25;
  std::size_t nearest = progress_;
  for (std::size_t k = 0; k < kWindow; ++k) {
    const std::size_t i = (progress_ + k) % route_.size();
    if ((route_[i] - p).squaredNorm() < (route_[nearest] - p).squaredNorm()) nearest = i;
  }
  progress_ = nearest;
  std::size_t target = nearest;
  for (std::size_t k = 0; k < kWindow && (route_[target] - p).norm() < params.look_ahead_m; ++k) {
    target = (target + 1) % route_.size();
  }
  const Vec2 to = route_[target] - p;
  const double yaw = core::RpyFromRotation(state.R_WB).z();
  const double error = core::WrapToPi(std::atan2(to.y(), to.x()) - yaw);
  Command wanted;
  wanted.v_x_mps = params.speed_mps * std::max(0.2, std::cos(error));
  wanted.w_z_radps = std::clamp(params.yaw_gain_per_s * error, -params.max_yaw_rate_radps,
                                params.max_yaw_rate_radps);
  const double gain = params.lag_s > 0.0 ? 1.0 - std::exp(-dt_s / params.lag_s) : 1.0;
  hand_.v_x_mps += gain * (wanted.v_x_mps - hand_.v_x_mps);
  hand_.w_z_radps += gain * (wanted.w_z_radps - hand_.w_z_radps);
  return hand_;
}

Command Operator::Update(const RobotState& state, double time_s, double dt_s) noexcept {
  if (const auto* route = std::get_if<RouteParams>(&params_))
    return FollowRoute(*route, state, dt_s);
  Command command;
  for (const VelocityStep& step : std::get<VelocityProgramme>(params_).steps) {
    if (time_s < step.at_s) break;
    command.v_x_mps = step.v_x_mps;
    command.v_y_mps = step.v_y_mps;
    command.w_z_radps = step.w_z_radps;
    command.pattern = step.pattern;
  }
  return command;
}

}  // namespace scoria::app
