// SPDX-License-Identifier: BSD-3-Clause
#include "app/gate/run_gate.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "analysis/study/compare.h"
#include "app/campaign/episode_folder.h"
#include "app/campaign/run_jobs.h"
#include "app/check/judge.h"
#include "app/gate/run_program.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using analysis::CampaignResults;
using analysis::EpisodeRecord;
using Line = analysis::RegressionEvidence::Line;

double Log10(double log_e) { return log_e / std::numbers::ln10; }

/// "height RMSE 3.1 -> 9.4 mm", with arm and point of the sweep where there are several.
std::string ChangeText(const Line& line, const CampaignResults& baseline) {
  const analysis::MetricInfo& m = line.metric;
  std::string where = baseline.arms.size() > 1 ? line.place.arm : "";
  if (!baseline.axes.empty())
    where += (where.empty() ? "" : ", ") + analysis::PointName(baseline.axes, line.place.point);
  return fmt::format("{} {} -> {}{}{}{}", m.title, analysis::ShownNumber(m, line.baseline_mean),
                     analysis::ShownNumber(m, line.mean), ShownUnit(m).empty() ? "" : " ",
                     ShownUnit(m), where.empty() ? "" : fmt::format(" ({})", where));
}

const EpisodeRecord* FindEpisode(const CampaignResults& results, const std::string& id) {
  const auto found = std::ranges::find(results.episodes, id, &EpisodeRecord::id);
  return found == results.episodes.end() ? nullptr : &*found;
}

class Gate {
 public:
  Gate(const Baseline& baseline, const GateOptions& options)
      : baseline_(baseline.results),
        seeds_(baseline.seeds),
        options_(options),
        evidence_(baseline.results, LoadTwin()),
        file_(options.file.empty() ? baseline.file : options.file),
        overrides_(baseline.overrides) {
    std::string cpu = CpuName();
    if (options.walked.empty()) {
      PlanWalks();
    } else {
      cpu = TakeWalked();
    }
    same_cpu_ = !baseline.cpu.empty() && baseline.cpu == cpu;
    if (!same_cpu_)
      Tell(
          fmt::format("the baseline was walked on another processor ({}; this is {}): bits are "
                      "not compared",
                      baseline.cpu.empty() ? "not recorded" : baseline.cpu, cpu));
  }

  GateResult Run() {
    if (!walked_) {
      core::CreateFolders(options_.folder / "episodes");
      WriteIndex(campaign_, jobs_, options_.folder);
    }
    for (std::size_t next = 0; static_cast<int>(next) < budget_;) {
      const std::vector<std::uint64_t> batch = NextSeeds(next);
      if (batch.empty()) break;
      next += batch.size();
      if (!walked_ && !Walk(batch)) return End(GateVerdict::kInterrupted);
      const CampaignResults now = walked_ ? *walked_ : analysis::LoadResults(options_.folder);
      if (walked_) result_.episodes += static_cast<int>(batch.size() * EpisodesPerSeed());
      if (const std::string broken = FindBroken(batch, now); !broken.empty()) {
        result_.sentence = broken;
        return End(GateVerdict::kBroken);
      }
      if (result_.seeds == 0 && same_cpu_ && AllEqual(batch, now)) {
        result_.seeds += static_cast<int>(batch.size());
        return End(GateVerdict::kEqual);
      }
      if (Judge(batch, now)) return End(GateVerdict::kWorse);
    }
    return End(GateVerdict::kNoEvidence);
  }

 private:
  void Tell(const std::string& line) const {
    if (options_.on_line) options_.on_line(line);
  }

  [[nodiscard]] CampaignResults LoadTwin() const {
    if (options_.twin.empty()) return {};
    CampaignResults twin = LoadBaseline(options_.twin).results;
    CheckDesign(options_.twin, twin);
    return twin;
  }

  void PlanWalks() {
    std::vector<std::string> overrides = overrides_;
    overrides.insert(overrides.end(), options_.overrides.begin(), options_.overrides.end());
    campaign_ = LoadCampaign(file_, overrides);
    campaign_.first_seed = seeds_.front();
    budget_ = options_.seeds > 0 ? options_.seeds : static_cast<int>(seeds_.size());
    campaign_.seeds = static_cast<int>(seeds_.back() - seeds_.front()) + 1 + budget_;
    jobs_ = Plan(campaign_);
    std::vector<std::string> arms;
    std::vector<std::vector<std::string>> axes;
    for (const CampaignArm& arm : campaign_.arms) arms.push_back(arm.name);
    for (const CampaignAxis& axis : campaign_.sweep) axes.push_back(axis.names);
    CheckDesign(file_, arms, axes);
  }

  /// Takes the seeds that both have. @returns the processor that walked them.
  std::string TakeWalked() {
    Baseline walked = LoadBaseline(options_.walked);
    CheckDesign(options_.walked, walked.results);
    std::erase_if(seeds_, [&](std::uint64_t s) { return !std::ranges::count(walked.seeds, s); });
    const int most = static_cast<int>(seeds_.size());
    budget_ = options_.seeds > 0 ? std::min(options_.seeds, most) : most;
    walked_ = std::move(walked.results);
    return walked.cpu;
  }

  void CheckDesign(const fs::path& of, const CampaignResults& results) const {
    std::vector<std::vector<std::string>> axes;
    for (const analysis::Axis& axis : results.axes) axes.push_back(axis.values);
    CheckDesign(of, results.arms, axes);
  }

  /// @param axes  values of each axis of the sweep.
  void CheckDesign(const fs::path& of, const std::vector<std::string>& arms,
                   const std::vector<std::vector<std::string>>& axes) const {
    const bool same_axes =
        std::ranges::equal(axes, baseline_.axes, {}, {}, &analysis::Axis::values);
    if (arms != baseline_.arms || !same_axes)
      throw std::runtime_error(
          fmt::format("{}: has other arms or another sweep than the baseline", of.string()));
  }

  /// Of the baseline's first seed, which is whole.
  [[nodiscard]] std::size_t EpisodesPerSeed() const {
    return static_cast<std::size_t>(
        std::ranges::count(baseline_.episodes, seeds_.front(), &EpisodeRecord::seed));
  }

  /// As many seeds as keep all workers busy, one of those that have been walked; further ones of
  /// the baseline are walked first.
  std::vector<std::uint64_t> NextSeeds(std::size_t next) {
    const std::size_t per_seed = EpisodesPerSeed(),
                      busy = (static_cast<std::size_t>(options_.workers) + per_seed - 1) / per_seed;
    const std::size_t wanted =
        std::min(walked_ ? 1 : busy, static_cast<std::size_t>(budget_) - next);
    if (next + wanted > seeds_.size() && !options_.baseline_program.empty()) WalkBaseline(wanted);
    std::vector<std::uint64_t> batch;
    for (std::size_t i = next; i < std::min(next + wanted, seeds_.size()); ++i)
      batch.push_back(seeds_[i]);
    if (batch.empty()) Tell("the baseline has no more seeds");
    return batch;
  }

  /// Further seeds of the baseline by the program that made it, into a campaign of their own.
  void WalkBaseline(std::size_t count) {
    const fs::path folder = options_.folder / "baseline";
    const std::uint64_t first = seeds_.back() + 1;
    std::vector<std::string> arguments = {options_.baseline_program, "campaign", file_.string()};
    for (const std::string& o : overrides_) arguments.insert(arguments.end(), {"--set", o});
    arguments.insert(arguments.end(), {"--set", fmt::format("first_seed={}", first), "--set",
                                       fmt::format("seeds={}", count), "--out", folder.string(),
                                       "--workers", fmt::format("{}", options_.workers)});
    core::CreateFolders(folder);
    const int code = RunProgram(arguments, folder / "baseline_program.txt");
    if (code != 0)
      throw std::runtime_error(fmt::format("{}: ended with exit code {}: {}",
                                           options_.baseline_program, code,
                                           core::ReadText(folder / "baseline_program.txt")));
    for (EpisodeRecord& e : analysis::LoadResults(folder).episodes)
      baseline_.episodes.push_back(std::move(e));
    for (std::size_t i = 0; i < count; ++i) seeds_.push_back(first + i);
  }

  /// @returns false if it was interrupted or the disk refused.
  bool Walk(const std::vector<std::uint64_t>& batch) {
    std::vector<FolderJob> jobs;
    for (const CampaignJob& job : jobs_) {
      if (std::ranges::count(batch, job.seed) > 0)
        jobs.push_back({&job, options_.folder / "episodes" / job.id});
    }
    JobsOptions options{options_.workers, options_.program, options_.interrupted, {}, {}};
    options.on_end = [](const FolderJob& job, const JobExit& exit) -> std::string {
      const WorkerEnd end = app::Judge(exit, job.folder);
      if (end == WorkerEnd::kDiskRefused) return WhyDiskRefused(job.folder);
      if (end == WorkerEnd::kCrashed) WriteCrash(job.folder, *job.job, exit);
      return "";
    };
    const JobsEnd end = RunJobs(jobs, options);
    result_.episodes += static_cast<int>(jobs.size()) - end.not_started;
    result_.disk_problem = end.problem;
    return !end.interrupted && end.problem.empty();
  }

  [[nodiscard]] std::string FindBroken(const std::vector<std::uint64_t>& batch,
                                       const CampaignResults& now) const {
    for (const EpisodeRecord& e : now.episodes) {
      const EpisodeRecord* before = FindEpisode(baseline_, e.id);
      if (before == nullptr || std::ranges::count(batch, e.seed) == 0) continue;
      const std::string problem = DescribeNoWalk(e);
      if (!problem.empty() && DescribeNoWalk(*before).empty())
        return fmt::format("{}: {}; the baseline walked", e.id, problem);
    }
    return "";
  }

  [[nodiscard]] bool AllEqual(const std::vector<std::uint64_t>& batch,
                              const CampaignResults& now) const {
    return std::ranges::all_of(now.episodes, [&](const EpisodeRecord& e) {
      if (std::ranges::count(batch, e.seed) == 0) return true;
      const EpisodeRecord* before = FindEpisode(baseline_, e.id);
      return before != nullptr && !e.state_hash.empty() && e.state_hash == before->state_hash;
    });
  }

  /// @returns true once there is evidence.
  bool Judge(const std::vector<std::uint64_t>& batch, const CampaignResults& now) {
    for (const std::uint64_t seed : batch) {
      evidence_.AddSeed(seed, baseline_, now);
      ++result_.seeds;
      const std::vector<Line> lines = evidence_.Lines();
      Tell(fmt::format("seed {:4}  {:4} episodes  evidence 10^{:.1f} of 10^{:.1f}  {}", seed,
                       result_.episodes, Log10(evidence_.evidence().log_e()),
                       -std::log10(options_.alpha),
                       lines.empty() ? "" : ChangeText(lines.front(), baseline_)));
      if (evidence_.evidence().Rejects(options_.alpha)) return true;
    }
    return false;
  }

  GateResult End(GateVerdict verdict) {
    result_.verdict = verdict;
    result_.p_value = evidence_.evidence().p_value();
    result_.lines = evidence_.Lines();
    if (verdict == GateVerdict::kWorse) result_.sentence = WorseSentence();
    if (verdict == GateVerdict::kEqual)
      result_.sentence = fmt::format("{} episodes have the bits of the baseline: nothing changed",
                                     result_.episodes);
    if (verdict == GateVerdict::kNoEvidence)
      result_.sentence = fmt::format(
          "no evidence in {} seeds that anything became worse (p = {:.2g}, level {:g}, {} metrics)",
          result_.seeds, result_.p_value, options_.alpha, result_.lines.size());
    if (verdict == GateVerdict::kInterrupted) result_.sentence = "not decided";
    return result_;
  }

  [[nodiscard]] std::string WorseSentence() const {
    constexpr std::size_t kMost = 3;
    std::string changes;
    for (std::size_t i = 0; i < std::min(kMost, result_.lines.size()); ++i) {
      if (result_.lines[i].log_e > 0.0)
        changes += fmt::format("{}{}", changes.empty() ? "" : ", ",
                               ChangeText(result_.lines[i], baseline_));
    }
    return fmt::format(
        "worse than the baseline after {} seeds (p = {:.2g}, level {:g}, {} "
        "metrics): {}",
        result_.seeds, result_.p_value, options_.alpha, result_.lines.size(), changes);
  }

  CampaignResults baseline_;
  std::vector<std::uint64_t> seeds_;
  const GateOptions& options_;
  analysis::RegressionEvidence evidence_;
  fs::path file_;
  std::vector<std::string> overrides_;
  bool same_cpu_ = false;
  std::optional<CampaignResults> walked_;  // by this build; nothing: the gate walks
  Campaign campaign_;
  int budget_ = 0;
  std::vector<CampaignJob> jobs_;
  GateResult result_;
};

}  // namespace

GateResult RunGate(const Baseline& baseline, const GateOptions& options) {
  std::optional<core::FolderLock> lock;
  if (options.walked.empty()) lock.emplace(options.folder);
  return Gate(baseline, options).Run();
}

}  // namespace scoria::app
