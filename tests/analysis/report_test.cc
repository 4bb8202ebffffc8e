// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/compare.h"
#include "analysis/html.h"
#include "analysis/terrain_view.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

/// A campaign folder as `scoria campaign` leaves it, with made-up results: arm b falls often, one
/// episode of c crashed.
void WriteCampaign(const fs::path& folder, const EstimationMetrics& estimation = {}) {
  nlohmann::json index = {
      {"name", "made <up>"},
      {"arms", {"a", "b"}},
      {"episodes", nlohmann::json::array()},
      {"sweep", {{{"key", "speed_mps"}, {"label", "speed [m/s]"}, {"values", {"0.3", "0.6"}}}}}};
  for (const char* arm : {"a", "b"}) {
    for (const char* speed : {"0.3", "0.6"}) {
      for (int seed = 1; seed <= 3; ++seed) {
        const std::string id = fmt::format("{}-{}-s{}", arm, speed, seed);
        index["episodes"].push_back({{"id", id}, {"arm", arm}, {"point", {speed}}, {"seed", seed}});
        fs::create_directories(folder / "episodes" / id);
        EpisodeMetrics m;
        m.distance_m = 50.0;
        m.mass_kg = 15.0;
        m.energy = {500.0, 300.0, 2000.0};
        m.cot_mech_abs = 0.5;
        m.cot_electrical = 2.0;
        for (int k = 0; k < 10; ++k)
          m.windows.push_back(
              {std::stod(speed) + 0.002 * k, std::stod(speed), 0.5 + 0.01 * k, 0.3, 2.0});
        m.estimation = estimation;
        const int falls = *arm == 'b' ? 6 : 0;
        for (int k = 0; k < falls; ++k) m.falls.push_back({1.0 * k, "tilt at x 0 m"});
        const nlohmann::json counters = {{"early_contact", 1}, {"mpc_failure", 0}};
        const nlohmann::json terrain = ToJson(
            {.nu_1m_m = 0.07, .hurst = 0.6, .slope_mean_rad = 0.2, .materials = {{"tuff", 1.0}}});
        nlohmann::json result = {{"end", "completed"},
                                 {"falls", falls},
                                 {"stuck", 0},
                                 {"walked_m", 50.0},
                                 {"real_time_factor", 15.0},
                                 {"us_per_step", {{"MPC", 5.0}, {"physics", 15.0}}},
                                 {"counters", counters},
                                 {"terrain", terrain},
                                 {"metrics", m}};
        if (id == "a-0.6-s3") result = {{"end", "crashed"}, {"message", "signal 11"}};
        std::ofstream(folder / "episodes" / id / "result.json") << result.dump();
      }
    }
  }
  std::ofstream(folder / "campaign.json") << index.dump();
}

/// Of an estimator that drifts by 2 % and a sensor that is 6 ms late and sometimes distrusted.
EstimationMetrics DriftingEstimation() {
  EstimationAccumulator e;
  for (int i = 0; i < 25000; ++i) {
    core::LogRow row;
    row.operating = true;
    row.time_s = 0.002 * i;
    row.p_WB_m = {0.001 * i, 0.0, 0.3};
    row.est_p_WB_m = {0.00102 * i, 0.0, 0.3};
    row.nees = 10.0;
    const auto stance = [](int at) { return at >= 0 && (at / 100) % 2 == 1; };
    row.true_contact.fill(stance(i));
    row.planned_stance.fill(stance(i + 5));
    row.contact_sensor.fill(stance(i - 3));
    row.contact = row.contact_sensor;
    row.contact_source.fill(2);
    row.sensor_healthy.fill(i % 1000 > 50);
    row.sensor_counts.fill(stance(i) ? 20.0 + i % 50 : i % 30);
    row.observer_probability.fill(stance(i) ? 0.6 + 0.01 * (i % 30) : 0.01 * (i % 70));
    row.contact_observer.fill(row.observer_probability[0] > 0.5);
    e.AddRow(row);
  }
  return e.Finish();
}

TEST(Compare, VerdictNamesWhoFallsLessWithItsInterval) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path());
  const CampaignResults results = LoadResults(folder.path());
  const Comparison c = Compare(results, "a", "b", {"0.3"});
  EXPECT_EQ(c.cell_a.falls.events, 0);
  EXPECT_EQ(c.cell_b.falls.events, 18);
  EXPECT_LT(c.ratio.interval.high, 1.0);
  EXPECT_EQ(c.verdict.find("speed [m/s] 0.3: a falls less than b: a fell 0 times in 150 m, b 18 "
                           "times in 150 m, rate ratio 0.00"),
            0u)
      << c.verdict;
  EXPECT_EQ(PoolCell(results, "a", {"0.6"}).broken, 1);
}

TEST(Report, IsSelfContainedAndShowsFailures) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path());
  const fs::path page = WriteReport(folder.path());
  std::ifstream in(page);
  std::stringstream text;
  text << in.rdbuf();
  const std::string html = text.str();
  EXPECT_NE(html.find("made &lt;up&gt;"), std::string::npos);
  EXPECT_NE(html.find("signal 11"), std::string::npos);
  EXPECT_NE(html.find("a falls less than b"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  int drawings = 0;
  for (std::size_t at = 0; (at = html.find("<svg", at)) != std::string::npos; ++at) ++drawings;
  EXPECT_GE(drawings, 5);
  for (const char* name :
       {"falls_speed_mps", "cot_mech_abs", "cot_electrical", "tracking", "solve_times"}) {
    for (const char* extension : {".gp", ".svg", ".png", ".pdf"}) {
      EXPECT_TRUE(fs::exists(page.parent_path() / "figures" / (std::string(name) + extension)))
          << name << extension;
    }
  }
  EXPECT_TRUE(fs::exists(page.parent_path() / "metrics.csv"));
}

TEST(Report, ShowsEstimationAndContactDetection) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), DriftingEstimation());
  const fs::path page = WriteReport(folder.path());
  const std::string html = core::ReadText(page);
  EXPECT_NE(html.find("<h2>State estimation</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>3</td><td>2.00</td><td>0.00</td><td>0.000</td>"), std::string::npos);
  EXPECT_NE(html.find("<h2>Contact detection</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>6 / 6</td>"), std::string::npos);
  EXPECT_NE(html.find("<td>momentum observer</td>"), std::string::npos);
  EXPECT_NE(html.find("sensor distrusted"), std::string::npos);
  for (const char* extension : {".gp", ".svg", ".png", ".pdf"})
    EXPECT_TRUE(
        fs::exists(page.parent_path() / "figures" / (std::string("contact_roc") + extension)));
  const std::string csv = core::ReadText(page.parent_path() / "metrics.csv");
  const std::string header = csv.substr(0, csv.find('\n'));
  const std::string line =
      csv.substr(header.size() + 1, csv.find('\n', header.size() + 1) - header.size() - 1);
  EXPECT_NE(header.find(",drift_horizontal_pct,"), std::string::npos);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(line.begin(), line.end(), ','));
  const auto json = nlohmann::json::parse(core::ReadText(page.parent_path() / "metrics.json"));
  EXPECT_NEAR(json.at("cells").at(0).at("estimation").at("nees_ratio").get<double>(), 2.0, 1e-12);
}

TEST(Report, IsSilentOnEstimationWhereTheTruthWasUsed) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path());
  const std::string html = core::ReadText(WriteReport(folder.path()));
  EXPECT_EQ(html.find("State estimation"), std::string::npos);
  EXPECT_EQ(html.find("Contact detection"), std::string::npos);
}

TEST(Report, MissingFolderIsNamed) {
  try {
    (void)WriteReport("/nonexistent/results");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()),
              "/nonexistent/results: holds neither campaign.json nor result.json");
  }
}

TEST(Html, EscapesText) { EXPECT_EQ(EscapeHtml("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;"); }

}  // namespace
}  // namespace scoria::analysis
