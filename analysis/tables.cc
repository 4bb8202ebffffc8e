// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/tables.h"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files.h"

namespace scoria::analysis {
namespace {

/// A CSV field.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

void WriteTables(const CampaignResults& results, const std::vector<Cell>& cells,
                 const std::filesystem::path& folder) {
  std::string csv = "id,arm";
  for (const Axis& axis : results.axes) csv += "," + axis.key;
  csv +=
      ",seed,end,distance_m,falls,stuck,cot_mech_abs,cot_mech_pos,cot_electrical,cot_battery,"
      "velocity_rmse_mps,"
      "height_rmse_m,"
      "roll_rmse_rad,pitch_rmse_rad,mpc_median_s,mpc_p99_s,wbc_median_s,wbc_p99_s,real_time_"
      "factor\n";
  for (const EpisodeRecord& e : results.episodes) {
    const EpisodeMetrics& m = e.metrics;
    csv += Quoted(e.id) + "," + Quoted(e.arm);
    for (const std::string& value : e.point) csv += "," + Quoted(value);
    csv +=
        fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", e.seed, e.end,
                    m.distance_m, e.falls, e.stuck, m.cot_mech_abs, m.cot_mech_pos,
                    m.cot_electrical, m.cot_battery, m.tracking.velocity_rmse_mps,
                    m.tracking.height_rmse_m, m.tracking.roll_rmse_rad, m.tracking.pitch_rmse_rad,
                    m.mpc.median_s, m.mpc.p99_s, m.wbc.median_s, m.wbc.p99_s, e.real_time_factor);
  }
  core::WriteText(folder / "metrics.csv", csv);

  nlohmann::json json = {{"name", results.name},
                         {"cells", nlohmann::json::array()},
                         {"comparisons", nlohmann::json::array()}};
  for (const Cell& c : cells) {
    json["cells"].push_back({{"arm", c.arm},
                             {"point", c.point},
                             {"metres", c.falls.exposure},
                             {"falls", c.falls.events},
                             {"falls_per_m", c.falls.rate},
                             {"falls_per_m_low", c.falls.interval.low},
                             {"falls_per_m_high", c.falls.interval.high},
                             {"cot_mech_abs", c.cot_mech_abs},
                             {"cot_mech_pos", c.cot_mech_pos},
                             {"cot_electrical", c.cot_electrical},
                             {"cot_battery", c.cot_battery},
                             {"stuck", c.stuck}});
  }
  if (results.arms.size() > 1) {
    for (const Comparison& c : AllComparisons(results)) {
      json["comparisons"].push_back({{"a", c.a},
                                     {"b", c.b},
                                     {"point", c.point},
                                     {"ratio", c.ratio.ratio},
                                     {"low", c.ratio.interval.low},
                                     {"high", c.ratio.interval.high},
                                     {"p_value", c.ratio.p_value},
                                     {"dispersion", c.dispersion.index},
                                     {"verdict", c.verdict}});
    }
  }
  core::WriteText(folder / "metrics.json", json.dump(2) + "\n");
}

}  // namespace scoria::analysis
