// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/terrain/terrain_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "analysis/plots/gnuplot.h"
#include "analysis/report/json_text.h"
#include "analysis/terrain/ground_colour.h"
#include "core/files.h"
#include "core/math/angles.h"

namespace scoria::analysis {
namespace {

using terrains::Heightfield;

constexpr int kPanel_px = 800, kMargin_px = 24, kCaption_px = 64, kLegend_px = 56;

cv::Vec3d ToPixel(const Vec3& rgb) { return 255.0 * cv::Vec3d(rgb.z(), rgb.y(), rgb.x()); }

/// Colour of the ground at a place, lit from the north-west.
cv::Vec3b ColourAt(const Heightfield& ground, const Vec2& p_W) {
  const Vec2 g = ground.At(p_W.x(), p_W.y()).gradient;
  const Vec3 normal = Vec3(-g.x(), -g.y(), 1.0).normalized();
  const Vec3 light = Vec3(-1.0, 1.0, 1.2).normalized();
  const double shade = 0.25 + 1.05 * std::max(0.0, normal.dot(light));
  const cv::Vec3d lit = shade * ToPixel(GroundColour(ground, p_W));
  cv::Vec3b out;
  for (int c = 0; c < 3; ++c) out[c] = cv::saturate_cast<uchar>(lit[c]);
  return out;
}

void Write(cv::Mat& image, const std::string& text, int x, int y, double size) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, {40, 40, 40}, 1, cv::LINE_AA);
}

/// A square of ground with edge_m, centred on the origin, with a scale bar.
void DrawPanel(cv::Mat& image, const Heightfield& ground, double edge_m, int left_px,
               const std::string& caption) {
  for (int y = 0; y < kPanel_px; ++y) {
    for (int x = 0; x < kPanel_px; ++x) {
      const Vec2 p_W = edge_m * Vec2((x + 0.5) / kPanel_px - 0.5, 0.5 - (y + 0.5) / kPanel_px);
      image.at<cv::Vec3b>(kCaption_px + y, left_px + x) = ColourAt(ground, p_W);
    }
  }
  Write(image, caption, left_px, kCaption_px - 10, 0.6);
  const double bar_m = edge_m > 20.0 ? 10.0 : 1.0;
  const int bar_px = static_cast<int>(kPanel_px * bar_m / edge_m), y = kCaption_px + kPanel_px - 20;
  cv::rectangle(image, {left_px + 14, y - 6, bar_px + 4, 10}, {255, 255, 255}, cv::FILLED);
  cv::rectangle(image, {left_px + 16, y - 4, bar_px, 6}, {20, 20, 20}, cv::FILLED);
  cv::rectangle(image, {left_px + 14, y - 30, 64, 22}, {255, 255, 255}, cv::FILLED);
  Write(image, fmt::format("{:.0f} m", bar_m), left_px + 20, y - 13, 0.55);
}

void DrawLegend(cv::Mat& image, const Heightfield& ground,
                const terrains::TerrainStatistics& statistics) {
  int x = kMargin_px;
  const int y = kCaption_px + kPanel_px + 34;
  for (std::size_t i = 0; i < statistics.materials.size(); ++i) {
    const auto& [name, fraction] = statistics.materials[i];
    cv::rectangle(image, {x, y - 14, 18, 18}, cv::Scalar(ToPixel(MaterialColour(ground, i))),
                  cv::FILLED);
    const std::string text = fmt::format("{} {:.0f} %", name, 100.0 * fraction);
    Write(image, text, x + 26, y, 0.55);
    int baseline = 0;
    x += 56 + cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.55, 1, &baseline).width;
  }
}

void WriteRelief(const Heightfield& ground, const terrains::TerrainParams& params,
                 const terrains::TerrainStatistics& s, const std::filesystem::path& file) {
  cv::Mat image(kCaption_px + kPanel_px + kLegend_px, 3 * kMargin_px + 2 * kPanel_px, CV_8UC3,
                cv::Scalar(255, 255, 255));
  const double edge_m = 2.0 * ground.half_size_m(), detail_m = std::min(edge_m, 6.0);
  DrawPanel(image, ground, edge_m, kMargin_px,
            fmt::format("{}: {:.1f} m, north up, light from the north-west", params.name, edge_m));
  DrawPanel(
      image, ground, detail_m, 2 * kMargin_px + kPanel_px,
      fmt::format("centre; nu(1 m) {:.3f} m, H {:.2f}, slope {:.0f} deg mean, {:.0f} deg 95 %",
                  s.nu_1m_m, s.hurst, s.slope_mean_rad * core::kDegreesPerRad,
                  s.slope_95_rad * core::kDegreesPerRad));
  DrawLegend(image, ground, s);
  std::vector<uchar> png;
  cv::imencode(".png", image, png);
  core::WriteText(file, std::string(png.begin(), png.end()));
}

Figure DeviogramFigure(const std::vector<terrains::Deviation>& deviogram, const std::string& name) {
  Figure figure("deviogram", fmt::format("Roughness of {} against scale", name), 800, 560);
  std::vector<std::vector<double>> measured, target;
  for (const terrains::Deviation& d : deviogram) {
    if (d.measured_m > 0.0) measured.push_back({d.lag_m, d.measured_m});
    if (d.target_m > 0.0) target.push_back({d.lag_m, d.target_m});
  }
  figure.Data("measured", measured);
  figure.Data("target", target);
  figure.Line("set logscale xy; set key left top Left reverse");
  figure.Line("set xlabel 'lag [m]'; set ylabel 'RMS height difference [m]'");
  std::string plot;
  if (!target.empty()) plot += "$target with lines lw 2 lc rgb '#999999' title 'target', ";
  plot +=
      "$measured with linespoints lw 2 pt 7 ps 0.6 lc rgb '#0072b2' title 'measured on the grid'";
  figure.Line(measured.empty() ? "set xrange [0.01:10]; set yrange [1e-4:1]; plot 1/0 notitle"
                               : "plot " + plot);
  return figure;
}

}  // namespace

nlohmann::json ToJson(const terrains::TerrainStatistics& s) {
  nlohmann::json materials = nlohmann::json::array();
  for (const auto& [name, fraction] : s.materials)
    materials.push_back({{"name", name}, {"fraction", fraction}});
  return {{"nu_10cm_m", s.nu_10cm_m},
          {"nu_25cm_m", s.nu_25cm_m},
          {"nu_1m_m", s.nu_1m_m},
          {"hurst", s.hurst},
          {"slope_mean_rad", s.slope_mean_rad},
          {"slope_95_rad", s.slope_95_rad},
          {"materials", materials}};
}

terrains::TerrainStatistics StatisticsFromJson(const nlohmann::json& json) {
  terrains::TerrainStatistics s;
  const auto read = [&](const char* key, double& value) {  // null: could not be measured
    value = json.at(key).is_null() ? std::numeric_limits<double>::quiet_NaN()
                                   : json.at(key).get<double>();
  };
  read("nu_10cm_m", s.nu_10cm_m);
  read("nu_25cm_m", s.nu_25cm_m);
  read("nu_1m_m", s.nu_1m_m);
  read("hurst", s.hurst);
  read("slope_mean_rad", s.slope_mean_rad);
  read("slope_95_rad", s.slope_95_rad);
  for (const nlohmann::json& share : json.at("materials"))
    s.materials.push_back({share.at("name"), share.at("fraction")});
  return s;
}

nlohmann::json TerrainJson(const Heightfield& ground, const terrains::TerrainParams& params,
                           const terrains::TerrainStatistics& statistics) {
  nlohmann::json json = ToJson(statistics);
  json["name"] = params.name;
  json["deviogram"] = nlohmann::json::array();
  for (const terrains::Deviation& d : terrains::MeasureDeviogram(ground, params)) {
    json["deviogram"].push_back(
        {{"lag_m", d.lag_m}, {"measured_m", d.measured_m}, {"target_m", d.target_m}});
  }
  return json;
}

void WriteTerrainView(const Heightfield& ground, const terrains::TerrainParams& params,
                      const terrains::TerrainStatistics& statistics,
                      const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  WriteRelief(ground, params, statistics, folder / "relief.png");
  DeviogramFigure(terrains::MeasureDeviogram(ground, params), Escape(params.name)).Render(folder);
  core::WriteText(folder / "terrain.json", JsonText(TerrainJson(ground, params, statistics)));
}

}  // namespace scoria::analysis
