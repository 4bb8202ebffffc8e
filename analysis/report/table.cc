// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/table.h"

#include <cmath>

#include <fmt/format.h>

namespace scoria::analysis {

Table CountTable(const std::string& title, const ArmCounts& counts,
                 const std::vector<std::string>& arms) {
  Table table;
  table.header = {title};
  table.header.insert(table.header.end(), arms.begin(), arms.end());
  for (const auto& [name, per_arm] : counts) {
    std::vector<std::string>& row = table.rows.emplace_back(1, name);
    for (const std::string& arm : arms)
      row.push_back(std::to_string(per_arm.contains(arm) ? per_arm.at(arm) : 0));
  }
  return table;
}

std::optional<double> When(bool any, double value) {
  return any ? std::optional(value) : std::nullopt;
}

std::string NumberText(std::optional<double> value, int digits) {
  return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "–";
}

std::string PValueText(double p) {
  constexpr double kLeast = 1e-4;
  return p < kLeast ? "< 0.0001" : fmt::format("{:.{}f}", p, p < 0.01 ? 4 : 3);
}

std::string ShareText(std::uint64_t part, std::uint64_t whole, int digits) {
  return NumberText(When(whole > 0, 100.0 * static_cast<double>(part) / static_cast<double>(whole)),
                    digits);
}

std::string CountText(const RateEstimate& falls) {
  return fmt::format("{} in {:.0f} m", falls.events, falls.exposure);
}

}  // namespace scoria::analysis
