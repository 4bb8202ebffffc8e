// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/log_inputs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>

#include "analysis/field/aligned_rows.h"
#include "app/run/log_origin.h"
#include "app/scenario/config_kinds.h"
#include "core/config/archive.h"
#include "logs/format/open_log.h"
#include "logs/interval_histogram.h"
#include "logs/messages/read_messages.h"
#include "logs/messages/scoria.h"
#include "logs/read_rows.h"

namespace scoria::app {
namespace {

/// How many rows hold each of the things that estimation takes.
struct Held {
  std::uint64_t rows = 0, whole = 0, accelerometer = 0, gyroscope = 0, joints = 0, torques = 0;
  std::uint64_t foot_forces = 0, plan = 0, truth = 0, true_contacts = 0, estimate = 0;
  std::uint64_t command = 0;

  void Add(const logs::Row& row) {
    ++rows;
    whole += logs::GroupsOf(row).count() > 1;
    command += row.command.has_value();
    plan += row.plan.has_value();
    truth += row.truth.has_value();
    true_contacts += row.true_contacts.has_value();
    estimate += row.estimate.has_value();
    if (!row.measured) return;
    accelerometer += row.measured->a_WS_S_mps2.has_value();
    gyroscope += row.measured->w_WS_S_radps.has_value();
    joints += row.measured->q_rad.has_value() && row.measured->qd_radps.has_value();
    torques += row.measured->tau_Nm.has_value();
    foot_forces += row.measured->foot_force_counts.has_value();
  }
  [[nodiscard]] static bool Most(std::uint64_t count, std::uint64_t of) { return 2 * count > of; }
};

bool HoldsScenario(const std::filesystem::path& log) {
  return logs::OpenLog(log)->contents().metadata.contains(kScenarioMetadata);
}

/// Robot, controller and gravity: the log's own where scoria wrote it, else the defaults for a
/// robot that is told.
void ChooseRobot(const LogInputOptions& options, const std::filesystem::path& robot_of_mapping,
                 LogInputs& inputs) {
  if (!options.robot && HoldsScenario(options.log)) {
    const LogOrigin origin = ReadLogOrigin(options.log);
    inputs.robot = RobotOf(origin);
    inputs.controller = origin.scenario.controller;
    inputs.gravity_mps2 = origin.scenario.gravity_mps2;
    return;
  }
  inputs.robot_file = options.robot.value_or(robot_of_mapping);
  if (inputs.robot_file.empty())
    throw std::runtime_error(
        fmt::format("{}: {} names no robot; name one with --robot", options.log.string(),
                    inputs.mapping.empty() ? "it" : "mapping " + inputs.mapping));
  inputs.robot = ReadScaledRobot(LoadKind("robot", inputs.robot_file, {}));
  core::ConfigNode nothing;
  nothing.kind = core::ConfigNode::Kind::kMap;
  core::ConfigContext context{.similarity = inputs.robot.similarity, .notes = {}};
  inputs.controller = core::ReadConfig<controller::ControllerParams>(nothing, context);
}

/// What most of the rows hold, as a whole.
void Describe(const Held& held, LogInputs& inputs) {
  inputs.rows = held.rows;
  inputs.accelerometer = Held::Most(held.accelerometer, held.rows);
  inputs.gyroscope = Held::Most(held.gyroscope, held.rows);
  inputs.joints = Held::Most(held.joints, held.rows);
  inputs.torques = Held::Most(held.torques, held.rows);
  inputs.foot_forces = Held::Most(held.foot_forces, held.rows);
  inputs.plan = Held::Most(held.plan, held.whole);
  inputs.truth = Held::Most(held.truth, held.whole);
  inputs.true_contacts = Held::Most(held.true_contacts, held.whole);
  inputs.command = held.command > 0;
  inputs.estimate = Held::Most(held.estimate, held.whole);
}

constexpr const char* kInputTopic = "/scoria/controller_input";

bool HasControllerInputs(const LogInputOptions& options, const logs::LogContents& contents) {
  return !options.rows.mapping && logs::HasOwnRows(contents) &&
         std::ranges::any_of(contents.channels,
                             [](const logs::LogChannel& c) { return c.topic == kInputTopic; });
}

/// What the sensors said in a step. @param row  of the same step, for what is no input.
logs::MeasuredRow MeasuredBy(const logs::msg::ControllerInput& input,
                             const std::optional<logs::MeasuredRow>& row) {
  logs::MeasuredRow measured = row.value_or(logs::MeasuredRow{});
  measured.q_rad = input.q_rad;
  measured.qd_radps = input.qd_radps;
  measured.tau_Nm = input.tau_nm;
  measured.a_WS_S_mps2 = input.specific_force_mps2;
  measured.w_WS_S_radps = input.rate_radps;
  measured.foot_force_counts = input.foot_force_raw;
  return measured;
}

bool NeedsAccelerometer(const controller::EstimatorParams& params) {
  return std::holds_alternative<controller::InekfEstimatorParams>(params) ||
         std::holds_alternative<controller::LinearKfParams>(params);
}

/// Without torques there is no momentum observer and no mass; without a plan the observer's fusion
/// takes no phase.
void RestrictContacts(const LogInputs& inputs, VariantSetup& out) {
  using controller::ContactChoice;
  controller::ControllerParams& p = out.params;
  constexpr double kNoWeight = 10.0;  // the largest deviation that the key allows
  if (!inputs.plan) p.contact.fusion.phase_deviation = kNoWeight;
  if (!inputs.torques && !std::holds_alternative<controller::NoAdaptationParams>(p.adaptation)) {
    p.adaptation = controller::NoAdaptationParams{};
    out.remarks.emplace_back("the log holds no torques: no mass is learned");
  }
  ContactChoice& source = p.contact.source;
  if (source == ContactChoice::kGaitPhase && !inputs.plan)
    throw std::runtime_error("the log holds no gait plan for controller.contact.source=gait_phase");
  const bool by_feet = source == ContactChoice::kSensor && inputs.foot_forces;
  if (inputs.torques || source == ContactChoice::kGaitPhase || source == ContactChoice::kTruth ||
      by_feet)
    return;
  if (!inputs.foot_forces && !inputs.true_contacts && !inputs.plan)
    throw std::runtime_error(
        "the log holds neither torques nor foot forces nor a gait plan: no contacts");
  source = inputs.foot_forces     ? ContactChoice::kSensor
           : inputs.true_contacts ? ContactChoice::kTruth
                                  : ContactChoice::kGaitPhase;
  out.remarks.push_back(fmt::format("the log holds no torques: contacts come from {}",
                                    inputs.foot_forces     ? "the foot forces"
                                    : inputs.true_contacts ? "the true contacts"
                                                           : "the gait plan"));
}

}  // namespace

logs::RowsReport ForEachInputRow(const LogInputOptions& options,
                                 const std::function<void(const logs::Row&)>& on_row) {
  const std::unique_ptr<logs::LogSource> source = logs::OpenLog(options.log);
  if (!HasControllerInputs(options, source->contents()))
    return logs::ForEachRow({options.log}, options.rows, on_row);
  if (const std::string other = logs::DescribeOtherLayout(*source); !other.empty())
    throw std::runtime_error(fmt::format("{}: {}", options.log.string(), other));
  logs::RowJoiner joiner([](const logs::Row&) {});
  std::string problem =
      logs::ProblemText(logs::ReadMessages(*source, {}, [&](const logs::LogMessage& m) {
        if (joiner.Add(m) || m.channel.topic != kInputTopic) return;
        const auto input = logs::Decode<logs::msg::ControllerInput>(m);
        const logs::Row& whole = joiner.row();  // a step's input is logged after its row
        const bool is_of_row = whole.episode && whole.episode->step == input.step;
        logs::Row row = is_of_row ? whole : logs::Row{};
        row.time_s = 1e-9 * static_cast<double>(m.log_time_ns);
        row.measured = MeasuredBy(input, is_of_row ? whole.measured : std::nullopt);
        on_row(row);
      }));
  if (const std::string rows = logs::DescribeRowProblems(*source, joiner); !rows.empty())
    problem += fmt::format("{}{}: {}", problem.empty() ? "" : "; ", options.log.string(), rows);
  return {std::nullopt, problem};
}

logs::RowsReport ForEachInputRow(const LogInputOptions& options, const LogInputs& inputs,
                                 const std::function<void(const logs::Row&)>& on_row) {
  if (!inputs.alignment || !inputs.alignment->alignment) return ForEachInputRow(options, on_row);
  analysis::AlignedRows aligned(*inputs.alignment->alignment, on_row);
  logs::RowsReport report =
      ForEachInputRow(options, [&](const logs::Row& row) { aligned.Add(row); });
  aligned.Finish();
  return report;
}

LogInputs SurveyInputs(const LogInputOptions& options) {
  LogInputs inputs;
  Held held;
  logs::IntervalHistogram intervals;
  std::optional<double> last_s;
  const logs::RowsReport report = ForEachInputRow(options, [&](const logs::Row& row) {
    held.Add(row);
    if (!last_s) inputs.first_s = row.time_s;
    if (last_s && row.time_s > *last_s) intervals.Add(std::llround(1e9 * (row.time_s - *last_s)));
    last_s = row.time_s;
  });
  if (intervals.count() == 0)
    throw std::runtime_error(fmt::format("{}: has no two rows to estimate on{}",
                                         options.log.string(),
                                         report.problem.empty() ? "" : "; " + report.problem));
  Describe(held, inputs);
  inputs.every_step = HasControllerInputs(options, logs::OpenLog(options.log)->contents());
  inputs.last_s = *last_s;
  inputs.period_s = 1e-9 * intervals.Quantile_ns(0.5);
  inputs.problem = report.problem;
  if (report.mapping) {
    inputs.mapping = report.mapping->mapping;
    inputs.truth_is_of_markers = report.mapping->truth_is_of_markers;
  }
  ChooseRobot(options, report.mapping ? report.mapping->robot : std::filesystem::path(), inputs);
  if (!inputs.foot_forces) inputs.robot.config.has_foot_sensors = false;
  if (!inputs.truth_is_of_markers) return inputs;
  analysis::TruthAlignmentEstimator estimator(&inputs.robot, inputs.gravity_mps2);
  (void)ForEachInputRow(options, [&](const logs::Row& row) { estimator.AddRow(row); });
  inputs.alignment = estimator.Estimate();
  return inputs;
}

VariantSetup SetUpVariant(const LogInputs& inputs, const std::vector<std::string>& set) {
  constexpr std::string_view kBelow = "controller.";
  core::ConfigNode node = core::WriteConfig(inputs.controller);
  for (const std::string& assignment : set) {
    if (!assignment.starts_with(kBelow))
      throw core::ConfigError({}, "",
                              fmt::format("{}: a replay can only change controller.*", assignment));
    core::ApplyAssignment(node, assignment.substr(kBelow.size()), {assignment, 0, 0, true});
  }
  core::ConfigContext context{.similarity = inputs.robot.similarity, .notes = {}};
  VariantSetup out{core::ReadConfig<controller::ControllerParams>(node, context), {}};
  controller::ControllerParams& p = out.params;
  const auto refuse = [](const std::string& what) { throw std::runtime_error(what); };
  if (!inputs.joints) refuse("the log holds no joint angles and speeds");
  if (!inputs.gyroscope) refuse("the log holds no rates of a gyroscope");
  if (!inputs.accelerometer && NeedsAccelerometer(p.estimator))
    refuse(
        "the log holds no accelerometer, which this estimator needs; "
        "controller.estimator.type=leg_odometry does without");
  if (controller::NeedsTruth(p.estimator) && !inputs.truth)
    refuse("the log holds no truth for controller.estimator.type=truth");
  if (controller::NeedsTruth(p.contact) && !inputs.true_contacts)
    refuse("the log holds no true contacts for controller.contact.source=truth");
  RestrictContacts(inputs, out);
  return out;
}

}  // namespace scoria::app
