// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "analysis/report/plain_text.h"
#include "app/campaign/campaign.h"
#include "app/campaign/campaign_plan.h"
#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/cli/test_goal_options.h"
#include "core/files.h"

namespace scoria::app {
namespace {

void PrintOutcome(const std::string& name, const CampaignOutcome& outcome,
                  const std::string& folder) {
  if (!outcome.disk_problem.empty()) Note(outcome.disk_problem);
  fmt::print("{}: {} episodes ({} from before, {} crashed, {} did not walk){} in {}\n", name,
             outcome.episodes, outcome.done_before, outcome.crashed, outcome.failed,
             outcome.interrupted ? ", interrupted" : "", folder);
  if (outcome.stop) fmt::print("{}\n", analysis::DescribeStop(*outcome.stop));
  if (outcome.unfinished > 0) {
    fmt::print("{} episodes are to be walked yet; {}the same command goes on with them\n",
               outcome.unfinished, outcome.disk_problem.empty() ? "" : "make room, and then ");
  }
}

/// As given, or of the campaign's earlier results.
std::optional<FallRate> RateFor(double falls_per_m, const std::filesystem::path& folder) {
  if (falls_per_m > 0.0) return FallRate{falls_per_m, "--falls-per-m"};
  if (!std::filesystem::exists(folder / "campaign.json")) return std::nullopt;
  return MeasuredFallRate(analysis::LoadResults(folder));
}

}  // namespace

void AddCampaign(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file, out;
    std::vector<std::string> set;
    int workers = 2;
    bool plan = false;
    analysis::TestGoal goal;
    double falls_per_m = 0.0;
  };
  auto o = std::make_shared<Options>();
  CLI::App* campaign =
      app.add_subcommand("campaign", "walk arms x sweep x seeds in worker processes; resumes");
  campaign->add_option("campaign", o->file, "campaign YAML")->required();
  campaign->add_option("--set", o->set,
                       "override a key, as seeds=10 or scenario.operator.distance_m=50");
  campaign->add_option("--out", o->out, "folder for the results (default out/NAME)");
  campaign->add_option("--workers", o->workers, "processes at a time")->check(CLI::Range(1, 1024));
  campaign->add_flag("--plan", o->plan,
                     "tell what the budget will be able to see, and walk nothing");
  campaign
      ->add_option("--falls-per-m", o->falls_per_m,
                   "for --plan: rate of the arm that falls less (default: of the results in the "
                   "folder, else several)")
      ->check(CLI::PositiveNumber);
  AddTestGoal(*campaign, o->goal);
  campaign->callback([o, &exit_code] {
    const Campaign loaded = LoadCampaign(o->file, o->set);
    for (const std::string& note : loaded.notes) Note(note);
    CampaignOptions options;
    options.folder = o->out.empty() ? std::filesystem::path("out") / core::FileNameOf(loaded.name)
                                    : std::filesystem::path(o->out);
    if (o->plan) {
      const auto rate = RateFor(o->falls_per_m, options.folder);
      fmt::print("{}", analysis::ToPlainText(PlanCampaign(loaded, o->goal, rate)));
      return;
    }
    options.workers = o->workers;
    options.program = std::filesystem::read_symlink("/proc/self/exe").string();
    options.interrupted = &Interrupted();
    options.on_again = [](const std::string& reason, int episodes) {
      Note(fmt::format("walked again: {} ({})",
                       episodes == 1 ? "1 episode" : fmt::format("{} episodes", episodes), reason));
    };
    const CampaignOutcome outcome = RunCampaign(loaded, options);
    PrintOutcome(loaded.name, outcome, options.folder.string());
    const bool stopped = outcome.interrupted || outcome.unfinished > 0;
    exit_code = !outcome.disk_problem.empty() ? kFileError : stopped ? kStopped : kOk;
  });
}

}  // namespace scoria::app
