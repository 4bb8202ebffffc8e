// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/campaign_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "analysis/report/table.h"
#include "app/run/walk_check.h"

namespace scoria::app {
namespace {

using analysis::Blocks;
using analysis::NumberText;
using analysis::Table;
using analysis::TestGoal;

/// What the campaign walks.
struct Budget {
  std::size_t episodes = 0, points = 1;
  double arm_m = 0.0;  // commanded of the arm that walks least, over the whole sweep
};

Budget BudgetOf(const Campaign& campaign) {
  Budget budget;
  const std::vector<CampaignJob> jobs = Plan(campaign);
  budget.episodes = jobs.size();
  budget.points = jobs.size() / campaign.arms.size() / static_cast<std::size_t>(campaign.seeds);
  budget.arm_m = std::numeric_limits<double>::infinity();
  for (const CampaignArm& arm : campaign.arms) {
    double way_m = 0.0;
    for (const CampaignJob& job : jobs) {
      if (job.arm == arm.name)
        way_m += CommandedWay(job.scenario.operation, job.scenario.duration_s);
    }
    budget.arm_m = std::min(budget.arm_m, way_m);
  }
  return budget;
}

std::string GoalText(const TestGoal& goal) {
  return fmt::format("power {:g} %, level {:g} %", 100.0 * goal.power, 100.0 * goal.alpha);
}

std::vector<FallRate> RatesToTry(const std::optional<FallRate>& rate) {
  if (rate) return {*rate};
  std::vector<FallRate> rates;
  for (const int metres : {30, 100, 300}) rates.push_back({1.0 / metres, "assumed"});
  return rates;
}

/// "480 m, 24 seeds" of each arm.
std::string CostText(double exposure_m, double seed_m) {
  if (!std::isfinite(exposure_m)) return "–";
  return fmt::format("{:.0f} m, {:.0f} seeds", exposure_m, std::ceil(exposure_m / seed_m));
}

Table FallTable(const Budget& budget, int seeds, const TestGoal& goal,
                const std::vector<FallRate>& rates) {
  constexpr std::array<double, 3> kRatios = {1.5, 2.0, 3.0};
  Table table{{"metres per fall", "known from", "ratio seen, whole sweep", "ratio seen, a point"},
              {}};
  for (const double ratio : kRatios) table.header.push_back(fmt::format("for {:g}", ratio));
  for (const FallRate& rate : rates) {
    const double point_m = budget.arm_m / static_cast<double>(budget.points);
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {NumberText(1.0 / rate.per_m, 0), rate.source,
           NumberText(analysis::DetectableRatio(rate.per_m, budget.arm_m, goal), 2),
           NumberText(analysis::DetectableRatio(rate.per_m, point_m, goal), 2)};
    for (const double ratio : kRatios)
      row.push_back(
          CostText(analysis::ExposureForRatio(rate.per_m, ratio, goal), budget.arm_m / seeds));
  }
  return table;
}

Table MetricTable(const TestGoal& goal) {
  Table table{{"effect size", "seeds"}, {}};
  for (const double effect : {0.2, 0.5, 0.8, 1.2, 2.0}) {
    const std::optional<long> pairs = analysis::PairsForEffect(effect, goal);
    table.rows.push_back({fmt::format("{:g}", effect), pairs ? std::to_string(*pairs) : "–"});
  }
  return table;
}

}  // namespace

std::optional<FallRate> MeasuredFallRate(const analysis::CampaignResults& results) {
  FallRate rate;
  double falls = 0.0, way_m = 0.0;
  for (const analysis::EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics || !e.metrics.outcome) continue;
    falls += e.metrics.outcome->falls;
    way_m += e.metrics.distance_m;
  }
  if (falls == 0.0 || way_m <= 0.0) return std::nullopt;
  return FallRate{falls / way_m, fmt::format("{:.0f} falls in {:.0f} m", falls, way_m)};
}

analysis::Document PlanCampaign(const Campaign& campaign, const TestGoal& goal,
                                const std::optional<FallRate>& rate) {
  const Budget budget = BudgetOf(campaign);
  analysis::Document document;
  document.title = fmt::format("{}: plan", campaign.name);
  document.head.text.push_back(analysis::Paragraph{fmt::format(
      "{} arms × {} points × {} seeds: {} episodes; {:.0f} m of each arm at most.",
      campaign.arms.size(), budget.points, campaign.seeds, budget.episodes, budget.arm_m)});
  const bool compares = campaign.arms.size() > 1 && budget.arm_m > 0.0;
  if (compares) {
    document.chapters.push_back(
        {"falls",
         fmt::format("Falls, {}", GoalText(goal)),
         {FallTable(budget, campaign.seeds, goal, RatesToTry(rate)),
          analysis::Note{
              "Smallest ratio of the rates of two arms that will be seen, if the arm that "
              "falls less has that rate; metres and seeds of each arm that it takes to "
              "see others. Falls are taken for Poisson given the terrain: more is needed "
              "where terrains treat the arms differently."}}});
  }
  document.chapters.push_back(
      {"metrics",
       fmt::format("Metrics, in pairs of seeds, {}", GoalText(goal)),
       {analysis::Paragraph{fmt::format(
            "{} seeds will see a mean difference of {} standard deviations of the differences.",
            campaign.seeds, NumberText(analysis::DetectableEffect(campaign.seeds, goal), 2))},
        MetricTable(goal)}});
  return document;
}

}  // namespace scoria::app
