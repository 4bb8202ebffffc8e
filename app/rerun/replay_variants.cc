// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay_variants.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "app/episode/rows.h"
#include "app/rerun/log_observer.h"
#include "app/rerun/replay_files.h"
#include "core/files.h"
#include "core/math/so3.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Rows that are read before the variants take them.
constexpr std::size_t kBatch = 2048;

core::ConfigError VariantError(const std::string& text, const std::string& rule) {
  return {{}, "", fmt::format("--variant {}: {}", text, rule)};
}

/// One variant, its scores and its files.
class VariantRun {
 public:
  VariantRun(const LogInputs& inputs, const Variant& variant, const ReplayOutputs& outputs)
      : inputs_(inputs), setup_(SetUp(inputs, variant)), observer_(inputs, setup_.params) {
    result_.name = variant.name;
    result_.set = variant.set;
    result_.remarks = setup_.remarks;
    keep_rows_ = !outputs.log.empty();
    if (!outputs.tum.empty())
      tum_ = std::make_unique<TumFile>(outputs.tum / (variant.name + ".tum"));
  }

  /// Takes a batch of rows; keeps its own of them for the log, if one is written.
  void Take(const std::vector<logs::Row>& rows) {
    kept_.clear();
    for (const logs::Row& row : rows) Take(row);
  }

  [[nodiscard]] const std::vector<logs::Row>& kept() const noexcept { return kept_; }

  [[nodiscard]] VariantResult Finish(std::vector<fs::path>& files) {
    result_.estimation = estimation_.Finish();
    result_.trajectory = trajectory_.Finish();
    result_.consistency = consistency_.Finish();
    result_.gaps = observer_.gaps();
    result_.started_in_motion = observer_.started_in_motion();
    if (mass_rows_ > 0)
      result_.mass = {sum_mass_kg_ / static_cast<double>(mass_rows_), last_sigma_kg_, tared_};
    if (feet_rows_ > 0 && inputs_.torques)
      result_.feet_carry_kg = sum_feet_N_ / static_cast<double>(feet_rows_) / inputs_.gravity_mps2;
    if (tum_) files.push_back(tum_->Publish());
    return std::move(result_);
  }

 private:
  static VariantSetup SetUp(const LogInputs& inputs, const Variant& variant) {
    try {
      return SetUpVariant(inputs, variant.set);
    } catch (const core::ConfigError& e) {
      throw core::ConfigError({}, "", fmt::format("--variant {}: {}", variant.name, e.what()));
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(fmt::format("variant {}: {}", variant.name, e.what()));
    }
  }

  void Take(const logs::Row& row) {
    if (!observer_.Step(row)) return;
    AddFeet();
    if (row.time_s >= 0.5 * (inputs_.first_s + inputs_.last_s)) AddMass();
    if (!IsWhole(inputs_, row)) return;
    logs::Row mine = row;
    if (!mine.episode) mine.episode = logs::EpisodeRow{.operating = true};
    mine.episode->segment = observer_.segment();
    FillSensed(observer_.sensed(), observer_.wb().mass_kg, inputs_.robot.config.has_foot_sensors,
               mine);
    result_.groups |= logs::GroupsOf(mine);
    estimation_.AddRow(mine);
    trajectory_.AddRow(mine);
    if (tum_) tum_->Add(mine.time_s, mine.estimate->p_WB_m, mine.estimate->rpy_rad);
    if (keep_rows_) kept_.push_back(std::move(mine));
  }

  /// A sphere that rolls without slip has a contact point at rest.
  void AddFeet() {
    const core::WholeBody& wb = observer_.wb();
    analysis::FeetInstant now{wb.state.p_WB, wb.p_WF, wb.v_WF, observer_.sensed().contact.contact};
    for (const Leg leg : kLegs) {
      const Vec3 centre_to_contact_W = -inputs_.robot.legs[leg].foot_radius_m * Vec3::UnitZ();
      now.v_WContact[leg] += wb.w_shank_W[leg].cross(centre_to_contact_W);
    }
    consistency_.Add(now, observer_.segment());
  }

  void AddMass() {
    for (const Leg leg : kLegs) sum_feet_N_ += observer_.sensed().contact.f_F_W[leg].z();
    ++feet_rows_;
    const controller::Adaptation& learned = observer_.sensed().adaptation;
    if (learned.mass_kg <= 0.0) return;
    sum_mass_kg_ += learned.mass_kg;
    last_sigma_kg_ = std::sqrt(learned.P(0, 0));
    tared_ = learned.tared;
    ++mass_rows_;
  }

  const LogInputs& inputs_;
  VariantSetup setup_;
  LogObserver observer_;
  VariantResult result_;
  analysis::EstimationAccumulator estimation_;
  analysis::TrajectoryErrorAccumulator trajectory_;
  analysis::ConsistencyAccumulator consistency_;
  std::uint64_t mass_rows_ = 0, feet_rows_ = 0;
  double sum_mass_kg_ = 0.0, sum_feet_N_ = 0.0, last_sigma_kg_ = 0.0;
  bool tared_ = false, keep_rows_ = false;
  std::vector<logs::Row> kept_;
  std::unique_ptr<TumFile> tum_;
};

/// What the log itself says: its estimate's scores, its rows and its trajectories in the files.
class LoggedRun {
 public:
  LoggedRun(const LogInputs& inputs, const ReplayOutputs& outputs) : inputs_(inputs) {
    if (!outputs.log.empty()) log_ = std::make_unique<ReplayLogFile>(outputs.log);
    if (outputs.tum.empty()) return;
    if (inputs.estimate) estimate_ = std::make_unique<TumFile>(outputs.tum / "logged.tum");
    if (inputs.truth) truth_ = std::make_unique<TumFile>(outputs.tum / "truth.tum");
  }

  void Take(const logs::Row& row) {
    if (!IsWhole(inputs_, row)) return;
    if (log_) log_->AddRow(row);
    if (estimate_ && row.estimate)
      estimate_->Add(row.time_s, row.estimate->p_WB_m, row.estimate->rpy_rad);
    if (truth_ && row.truth) truth_->Add(row.time_s, row.truth->p_WB_m, row.truth->rpy_rad);
    if (!row.estimate) return;
    logs::Row scored = row;
    if (!scored.episode) scored.episode = logs::EpisodeRow{.operating = true};
    groups_ |= logs::GroupsOf(scored);
    estimation_.AddRow(scored);
    trajectory_.AddRow(scored);
  }

  void Add(const std::string& variant, const std::vector<logs::Row>& rows) {
    if (!log_) return;
    for (const logs::Row& row : rows) log_->AddVariant(variant, row);
  }

  void Finish(ReplayReport& report) {
    if (inputs_.estimate) {
      report.logged = estimation_.Finish();
      report.logged_trajectory = trajectory_.Finish();
    }
    report.logged_groups = groups_;
    if (log_) report.files.push_back(log_->Publish());
    if (estimate_) report.files.push_back(estimate_->Publish());
    if (truth_) report.files.push_back(truth_->Publish());
  }

 private:
  const LogInputs& inputs_;
  std::unique_ptr<ReplayLogFile> log_;
  std::unique_ptr<TumFile> estimate_, truth_;
  analysis::EstimationAccumulator estimation_;
  analysis::TrajectoryErrorAccumulator trajectory_;
  logs::RowGroups groups_;
};

/// All runs over one batch of rows, on threads.
void TakeAll(std::vector<std::unique_ptr<VariantRun>>& runs, const std::vector<logs::Row>& rows,
             int workers) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size(); i = next++) runs[i]->Take(rows);
  };
  std::vector<std::jthread> threads;
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(workers), runs.size());
  for (std::size_t i = 1; i < count; ++i) threads.emplace_back(work);
  work();
}

void CheckOutputs(const ReplayOutputs& outputs, const std::vector<Variant>& variants) {
  std::set<std::string> names = {"logged", "truth"};  // of files
  for (const Variant& variant : variants) {
    if (!names.insert(variant.name).second)
      throw VariantError(variant.name, "there is another of this name");
  }
  std::vector<fs::path> files;
  if (!outputs.log.empty()) files.push_back(outputs.log);
  if (!outputs.tum.empty()) {
    for (const std::string& name : names) files.push_back(outputs.tum / (name + ".tum"));
    core::CreateFolders(outputs.tum);
  }
  if (outputs.log.has_parent_path()) core::CreateFolders(outputs.log.parent_path());
  for (const fs::path& file : files) {
    if (fs::exists(file) && !outputs.force)
      throw std::runtime_error(
          fmt::format("{}: is there already; --force overwrites it", file.string()));
  }
}

}  // namespace

Variant ParseVariant(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  constexpr const char* kForm = "is not NAME=key=value,key=value";
  if (equals == std::string::npos || name.empty()) throw VariantError(text, kForm);
  constexpr const char* kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (name.find_first_not_of(kAllowed) != std::string::npos)
    throw VariantError(text, "a name is of letters, digits, _ - and .");
  Variant variant{name, {}};
  int depth = 0;
  std::string part;
  for (const char c : text.substr(equals + 1) + ",") {
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (c != ',' || depth > 0) {
      part += c;
      continue;
    }
    if (part.find('=') == std::string::npos) throw VariantError(text, kForm);
    variant.set.push_back(std::exchange(part, {}));
  }
  if (depth != 0) throw VariantError(text, "a bracket is not closed");
  return variant;
}

ReplayReport ReplayVariants(const LogInputOptions& options, const std::vector<Variant>& variants,
                            const ReplayOutputs& outputs, int workers) {
  ReplayReport report{.inputs = SurveyInputs(options),
                      .logged = {},
                      .logged_groups = {},
                      .logged_trajectory = {},
                      .variants = {},
                      .files = {}};
  CheckOutputs(outputs, variants);
  std::vector<std::unique_ptr<VariantRun>> runs;
  for (const Variant& variant : variants)
    runs.push_back(std::make_unique<VariantRun>(report.inputs, variant, outputs));
  LoggedRun logged(report.inputs, outputs);
  std::vector<logs::Row> batch;
  const auto flush = [&] {
    TakeAll(runs, batch, workers);
    for (std::size_t i = 0; i < runs.size(); ++i) logged.Add(variants[i].name, runs[i]->kept());
    batch.clear();
  };
  (void)ForEachInputRow(options, report.inputs, [&](const logs::Row& row) {
    logged.Take(row);
    batch.push_back(row);
    if (batch.size() == kBatch) flush();
  });
  flush();
  logged.Finish(report);
  for (std::unique_ptr<VariantRun>& run : runs)
    report.variants.push_back(run->Finish(report.files));
  return report;
}

}  // namespace scoria::app
