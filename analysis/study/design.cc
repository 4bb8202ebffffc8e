// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/design.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/statistics/sampling.h"
#include "analysis/statistics/sobol_indices.h"
#include "core/config/field.h"

namespace scoria::analysis {

double Factor::At(double u) const noexcept {
  return scale == FactorScale::kLog ? from * std::pow(to / from, u) : from + u * (to - from);
}

Design MakeDesign(DesignKind kind, std::vector<Factor> factors, std::size_t points,
                  std::uint64_t seed) {
  const std::size_t rows = points / PointsPerRow(factors.size());
  const std::size_t dimensions = 2 * factors.size();
  const std::vector<UnitPoint> sample = kind == DesignKind::kSobol
                                            ? SampleSobol(rows, dimensions, seed)
                                            : SampleLatinHypercube(rows, dimensions, seed);
  Design design{kind, std::move(factors), {}};
  for (const UnitPoint& unit : SensitivityPoints(sample)) {
    std::vector<std::string>& values = design.points.emplace_back();
    for (std::size_t k = 0; k < unit.size(); ++k)
      values.push_back(fmt::format("{:.6g}", design.factors[k].At(unit[k])));
  }
  return design;
}

nlohmann::json ToJson(const Design& design) {
  nlohmann::json factors = nlohmann::json::array();
  for (const Factor& f : design.factors) {
    factors.push_back({{"key", f.key},
                       {"label", f.label},
                       {"from", f.from},
                       {"to", f.to},
                       {"scale", core::EnumName(f.scale)}});
  }
  return {{"kind", core::EnumName(design.kind)}, {"factors", factors}, {"points", design.points}};
}

Design DesignFromJson(const nlohmann::json& json) {
  Design design;
  const bool sobol = json.at("kind") == core::EnumName(DesignKind::kSobol);
  design.kind = sobol ? DesignKind::kSobol : DesignKind::kLatinHypercube;
  for (const nlohmann::json& f : json.at("factors")) {
    const bool log = f.at("scale") == core::EnumName(FactorScale::kLog);
    design.factors.push_back({f.at("key"), f.at("label"), f.at("from"), f.at("to"),
                              log ? FactorScale::kLog : FactorScale::kLinear});
  }
  json.at("points").get_to(design.points);
  return design;
}

}  // namespace scoria::analysis
