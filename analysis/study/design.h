// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace scoria::analysis {

enum class DesignKind { kSobol, kLatinHypercube };
constexpr std::array<std::pair<DesignKind, std::string_view>, 2> EnumNames(DesignKind) {
  return {{{DesignKind::kSobol, "sobol"}, {DesignKind::kLatinHypercube, "latin_hypercube"}}};
}

enum class FactorScale { kLinear, kLog };
constexpr std::array<std::pair<FactorScale, std::string_view>, 2> EnumNames(FactorScale) {
  return {{{FactorScale::kLinear, "linear"}, {FactorScale::kLog, "log"}}};
}

/// A number of the scenario that a design varies.
struct Factor {
  std::string key, label;
  double from = 0.0, to = 1.0;
  FactorScale scale = FactorScale::kLinear;

  /// @param u  in [0, 1].
  [[nodiscard]] double At(double u) const noexcept;
};

/// Points spread over the ranges of several factors, as SensitivityPoints orders them.
struct Design {
  DesignKind kind = DesignKind::kSobol;
  std::vector<Factor> factors;
  std::vector<std::vector<std::string>> points;  // the factors' values, as the scenarios have them
};

/// @param points  at most; whole rows of SensitivityPoints are made. Values have six digits.
/// @pre points >= PointsPerRow(factors). Errors: none.
[[nodiscard]] Design MakeDesign(DesignKind kind, std::vector<Factor> factors, std::size_t points,
                                std::uint64_t seed);

[[nodiscard]] nlohmann::json ToJson(const Design& design);
/// Errors: nlohmann::json::exception.
[[nodiscard]] Design DesignFromJson(const nlohmann::json& json);

}  // namespace scoria::analysis
