// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/draft_numbers.h"

#include <algorithm>
#include <cmath>

namespace scoria::logs {
namespace {

double MeanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

std::vector<double> Norms(const std::vector<const CatalogField*>& fields) {
  std::size_t size = fields.empty() ? 0 : fields[0]->values.size();
  for (const CatalogField* field : fields) size = std::min(size, field->values.size());
  std::vector<double> norms(size);
  for (std::size_t i = 0; i < size; ++i) {
    double sum = 0.0;
    for (const CatalogField* field : fields) sum += field->values[i] * field->values[i];
    norms[i] = std::sqrt(sum);
  }
  return norms;
}

/// Columns from `first` on.
std::vector<const CatalogField*> Columns(const CatalogTopic& topic, std::size_t first,
                                         std::size_t count) {
  std::vector<const CatalogField*> columns;
  for (std::size_t k = first; k < std::min(first + count, topic.fields.size()); ++k)
    columns.push_back(&topic.fields[k]);
  if (columns.size() < count) columns.clear();
  return columns;
}

/// Twelve columns as joint angles: every third a knee that is bent one way, all within a turn.
bool AreAngles(const std::vector<const CatalogField*>& columns) {
  constexpr double kBent_rad = 0.5, kMost_rad = 3.5;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto [low, high] =
        std::minmax_element(columns[k]->values.begin(), columns[k]->values.end());
    if (low == columns[k]->values.end() || *low < -kMost_rad || *high > kMost_rad) return false;
    const bool is_knee = k % 3 == 2;
    if (is_knee && *high > -kBent_rad) return false;
    if (!is_knee && MeanOf(columns[k]->values) < -kBent_rad) return false;
  }
  return columns.size() == 12;
}

/// How much the columns `b` go with the steps of the columns `a`: a correlation over all.
double GoesWithSteps(const std::vector<const CatalogField*>& a,
                     const std::vector<const CatalogField*>& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto &x = a[k]->values, &y = b[k]->values;
    for (std::size_t i = 1; i + 1 < std::min(x.size(), y.size()); ++i) {
      const double step = x[i + 1] - x[i - 1];
      ab += step * y[i];
      aa += step * step;
      bb += y[i] * y[i];
    }
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// Joints from `first` on, and blocks of twelve behind them. @returns columns used.
std::size_t GuessJoints(const CatalogTopic& topic, std::size_t first,
                        std::vector<NumberGuess>& guesses) {
  const auto q = Columns(topic, first, 12);
  if (!AreAngles(q)) return 0;
  guesses.push_back({"joints", "q", first, "", "by the knees, every third, which bend one way"});
  const auto second = Columns(topic, first + 12, 12), third = Columns(topic, first + 24, 12);
  if (second.empty()) return 12;
  const double with_second = GoesWithSteps(q, second);
  const double with_third = third.empty() ? 0.0 : GoesWithSteps(q, third);
  const bool second_is_rate = with_second >= with_third;
  guesses.push_back(
      {"joints", second_is_rate ? "qd" : "tau", first + 12, "",
       second_is_rate ? "goes with the steps of q" : "goes less with the steps of q"});
  if (third.empty()) return 24;
  guesses.push_back({"joints", second_is_rate ? "tau" : "qd", first + 24, "",
                     second_is_rate ? "what is left" : "goes with the steps of q"});
  return 36;
}

/// An attitude from `first` on. @returns columns used.
std::size_t GuessAttitude(const CatalogTopic& topic, std::size_t first, bool has_position,
                          std::vector<NumberGuess>& guesses) {
  const auto columns = Columns(topic, first, 4);
  if (columns.empty() || std::abs(MeanNorm(columns) - 1.0) > 0.01 || SpreadOfNorm(columns) > 0.01)
    return 0;
  const bool w_first = std::abs(MeanOf(columns[0]->values)) > std::abs(MeanOf(columns[3]->values));
  guesses.push_back({has_position ? "truth" : "imu", "attitude", first,
                     w_first ? ", order: wxyz" : ", order: xyzw",
                     "of length 1; its largest number is taken for w"});
  return 4;
}

}  // namespace

double MeanNorm(const std::vector<const CatalogField*>& fields) { return MeanOf(Norms(fields)); }

double SpreadOfNorm(const std::vector<const CatalogField*>& fields) {
  const std::vector<double> norms = Norms(fields);
  const double mean = MeanOf(norms);
  double sum = 0.0;
  for (const double norm : norms) sum += (norm - mean) * (norm - mean);
  return norms.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(norms.size()));
}

std::vector<NumberGuess> GuessByNumbers(const CatalogTopic& topic) {
  std::vector<NumberGuess> guesses;
  std::size_t at = 1;  // the first column is the time
  // Three numbers and an attitude behind them are a pose.
  const bool is_pose = topic.fields.size() == 8;
  if (is_pose && GuessAttitude(topic, 4, true, guesses) > 0) {
    double largest = 0.0;
    for (const CatalogField* column : Columns(topic, 1, 3)) {
      for (const double value : column->values) largest = std::max(largest, std::abs(value));
    }
    guesses.push_back({"truth", "position", 1, largest > 100.0 ? ", unit: mm" : "",
                       "before an attitude; truth, or the robot's estimate?"});
    return guesses;
  }
  while (at < topic.fields.size()) {
    std::size_t used = GuessJoints(topic, at, guesses);
    if (used == 0) used = GuessAttitude(topic, at, false, guesses);
    const auto three = Columns(topic, at, 3);
    if (used == 0 && !three.empty() && std::abs(MeanNorm(three) - 9.7) < 0.8 &&
        SpreadOfNorm(three) < 5.0) {
      guesses.push_back({"imu", "acceleration", at, "", "of the length of gravity"});
      used = 3;
    }
    const auto before_gravity = Columns(topic, at + 3, 3);
    const bool is_rate = used == 0 && !guesses.empty() && guesses.back().key == "attitude" &&
                         !before_gravity.empty() && std::abs(MeanNorm(before_gravity) - 9.7) < 0.8;
    if (is_rate) {
      guesses.push_back({"imu", "rate", at, "", "between attitude and acceleration"});
      used = 3;
    }
    at += std::max<std::size_t>(used, 1);
  }
  return guesses;
}

}  // namespace scoria::logs
