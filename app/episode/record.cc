// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "app/episode/arrays.h"
#include "app/run/log_origin.h"
#include "app/version.h"
#include "core/math/so3.h"
#include "logs/format/cdr.h"
#include "logs/read_rows.h"

namespace scoria::app {
namespace {

namespace msg = logs::msg;

constexpr double kHeartbeat_s = 0.5;

/// The topics, in the order of RecordedTopics().
enum TopicId {
  kJointStates,
  kImu,
  kContactState,
  kJointCmd,
  kQuadState,
  kGaitState,
  kControlTarget,
  kWbcTarget,
  kSolveTime,
  kWbcSolveTime,
  kBattery,
  kHeartbeat,
  kModel,
  kHash,
  kEvent,
  kStart,
  kInput,
  kFirstRowGroup,
};

std::int64_t ToNanoseconds(double time_s) { return std::llround(time_s * 1e9); }

msg::Header MakeHeader(double time_s, const char* frame) {
  const std::int64_t ns = ToNanoseconds(time_s);
  msg::Header header;
  header.stamp.sec = static_cast<std::int32_t>(ns / 1'000'000'000);
  header.stamp.nanosec = static_cast<std::uint32_t>(ns % 1'000'000'000);
  header.frame_id = frame;
  return header;
}

template <class V = msg::Vector3>
V ToMessage(const Vec3& v) {
  V out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

msg::Quaternion ToMessage(const Mat3& R) {
  const Quat q = Quat(R).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}

/// Preset 4, "total", of the reference's record_experiment.sh. Its /controller_hartbeat is a slip
/// that records nothing; /gait_sequence, /open_loop_trajectory and what other devices send are not
/// scoria's.
bool IsOfReference(std::string_view topic) {
  constexpr std::array<std::string_view, 12> kTopics = {
      "/quad_state", "/joint_states",   "/imu_measurement",   "/contact_state",
      "/joint_cmd",  "/wbc_target",     "/battery_state",     "/gait_state",
      "/solve_time", "/wbc_solve_time", "/quad_model_update", "/quad_control_target"};
  return std::find(kTopics.begin(), kTopics.end(), topic) != kTopics.end();
}

template <class Message>
Topic MakeTopic(const std::string& name, bool reproducible = true) {
  return {name,
          Message::kTypeName,
          logs::SchemaWriter::SchemaOf<Message>(),
          reproducible,
          IsOfReference(name),
          [](std::span<const std::byte> bytes) {
            auto message = logs::DecodeCdr<Message>(bytes);
            logs::FieldLister lister;
            message.Serialize(lister);
            return lister.fields();
          }};
}

msg::JointState MakeJointState(const StepRecord& r) {
  msg::JointState m;
  m.position = Flatten(r.sensors.q);
  m.velocity = Flatten(r.sensors.qd);
  m.effort = Flatten(r.sensors.tau_Nm);
  return m;
}

msg::QuadState MakeQuadState(const StepRecord& r) {
  const controller::StateEstimate& e = r.control.estimate;
  msg::QuadState m;
  m.header = MakeHeader(r.time_s, "world");
  m.pose.pose.position = ToMessage<msg::Point>(e.state.p_WB);
  m.pose.pose.orientation = ToMessage(e.state.R_WB);
  m.twist.twist.linear = ToMessage(e.state.v_WB);
  m.twist.twist.angular = ToMessage(e.state.w_WB);
  m.acceleration.linear = ToMessage(r.control.contact.vd_WB);
  m.acceleration.angular = ToMessage(r.control.contact.wd_WB);
  m.joint_state = MakeJointState(r);
  m.foot_contact = ToArray(r.control.contact.contact);
  m.ground_contact_force = Flatten(r.control.contact.f_F_W);
  return m;
}

msg::Imu MakeImu(const StepRecord& r) {
  msg::Imu m;
  m.header = MakeHeader(r.time_s, "imu_frame");
  m.orientation = ToMessage(r.control.estimate.state.R_WB);
  m.angular_velocity = ToMessage(r.sensors.w_WS_S);
  m.linear_acceleration = ToMessage(r.sensors.a_WS_S);
  return m;
}

msg::JointCmd MakeJointCmd(const StepRecord& r) {
  const JointCommand& command = r.control.command;
  msg::JointCmd m;
  m.header = MakeHeader(r.time_s, "");
  m.position = Flatten(command.q);
  m.velocity = Flatten(command.qd);
  m.effort = Flatten(command.tau_Nm);
  m.kp = Flatten(command.kp_Nm_per_rad);
  m.kd = Flatten(command.kd_Nms_per_rad);
  return m;
}

/// What the controller acts on.
msg::QuadModel MakeQuadModel(const StepRecord& r) {
  const controller::Adaptation& learned = r.control.adaptation;
  msg::QuadModel m;
  m.header = MakeHeader(r.time_s, "base_link");
  m.mass = r.control.model_mass_kg;
  m.com = ToArray(learned.p_BC);
  const Mat3& I = learned.parameters.trunk.I_C;
  std::copy(I.data(), I.data() + I.size(), m.inertia.begin());
  return m;
}

msg::WBCTarget MakeWbcTarget(const StepRecord& r) {
  msg::WBCTarget m;
  m.header = MakeHeader(r.time_s, "world");
  const BodyReference::Stage& target = r.control.target;
  m.pose.position = ToMessage<msg::Point>(target.p_WC);
  m.pose.orientation = ToMessage(core::RotationFromRpy(target.rpy_rad));
  m.twist.linear = ToMessage(target.v_WC);
  m.twist.angular = ToMessage(target.w_WB);
  for (const Leg leg : kLegs) {
    const auto i = static_cast<std::size_t>(leg);
    m.feet_contacts[i] = r.control.legs.InContact(leg);
    m.feet_pos_targets[i] = ToMessage(r.control.feet[leg].p_WF);
    m.feet_vel_targets[i] = ToMessage(r.control.feet[leg].v_WF);
    m.feet_acc_targets[i] = ToMessage(r.control.feet[leg].a_WF);
    m.feet_wrenches[i] = ToMessage(r.control.f_F_W[leg]);
  }
  return m;
}

msg::GaitState MakeGaitState(const StepRecord& r) {
  const ContactPlan& plan = r.control.contacts;
  msg::GaitState m;
  m.period = plan.period_s;
  m.duty_factor = ToArray(plan.duty);
  m.phase_offset = ToArray(plan.offset);
  m.contact = ToArray(plan.stance);
  m.phase = ToArray(plan.phase);
  m.gait_sequencer = std::holds_alternative<controller::AgsParams>(r.gait) ? 1 : 0;
  return m;
}

msg::QuadControlTarget MakeControlTarget(const StepRecord& r) {
  msg::QuadControlTarget m;
  m.body_x_dot = r.command.v_x_mps;
  m.body_y_dot = r.command.v_y_mps;
  m.hybrid_theta_dot = r.command.w_z_radps;
  m.world_z = r.control.reference.p_WC.z() - r.control.ground_z_m;
  m.pitch = r.command.pitch_rad;
  m.roll = r.command.roll_rad;
  return m;
}

msg::MPCDiagnostics MakeMpcDiagnostics(const StepRecord& r) {
  msg::MPCDiagnostics m;
  m.header = MakeHeader(r.time_s, "");
  m.solve_time = m.acados_total_time = r.control.mpc_solve_s;
  m.acados_num_iter = r.control.mpc_iterations;
  m.acados_return = static_cast<std::int64_t>(r.control.mpc_status);
  return m;
}

msg::ControllerInfo MakeControllerInfo(const StepRecord& r) {
  const auto count = [&](Count c) { return static_cast<std::uint32_t>(r.counters[c]); };
  msg::ControllerInfo m;
  m.header = MakeHeader(r.time_s, "");
  m.num_early_contacts = count(Count::kEarlyContact);
  m.num_mpc_solver_overtime = count(Count::kMpcLate);
  m.num_wbc_overtime = count(Count::kWbcLate);
  m.num_mpc_solver_fail = count(Count::kMpcFailure);
  m.num_wbc_solver_fail = count(Count::kWbcFailure);
  m.keep_pose_active = r.control.contacts.standing;
  return m;
}

msg::ControllerInput MakeControllerInput(const StepRecord& r) {
  const SensorFrame& z = r.sensors;
  msg::ControllerInput m;
  m.step = z.step;
  m.imu_time_s = z.imu_time_s;
  m.q_rad = Flatten(z.q);
  m.qd_radps = Flatten(z.qd);
  m.tau_nm = Flatten(z.tau_Nm);
  m.specific_force_mps2 = ToArray(z.a_WS_S);
  m.rate_radps = ToArray(z.w_WS_S);
  m.foot_force_raw = ToArray(z.foot_force_raw);
  m.v_x_mps = r.command.v_x_mps;
  m.v_y_mps = r.command.v_y_mps;
  m.w_z_radps = r.command.w_z_radps;
  m.height_m = r.command.height_m;
  m.roll_rad = r.command.roll_rad;
  m.pitch_rad = r.command.pitch_rad;
  m.pattern = static_cast<std::uint8_t>(r.command.pattern);
  m.mpc_fault = static_cast<std::uint8_t>(r.faults.mpc);
  m.wbc_fault = static_cast<std::uint8_t>(r.faults.wbc);
  return m;
}

std::vector<Topic> FixedTopics() {
  return {
      MakeTopic<msg::JointState>("/joint_states"),
      MakeTopic<msg::Imu>("/imu_measurement"),
      MakeTopic<msg::ContactState>("/contact_state"),
      MakeTopic<msg::JointCmd>("/joint_cmd"),
      MakeTopic<msg::QuadState>("/quad_state"),
      MakeTopic<msg::GaitState>("/gait_state"),
      MakeTopic<msg::QuadControlTarget>("/quad_control_target"),
      MakeTopic<msg::WBCTarget>("/wbc_target"),
      MakeTopic<msg::MPCDiagnostics>("/solve_time", false),
      MakeTopic<msg::WBCReturn>("/wbc_solve_time", false),
      MakeTopic<msg::BatteryState>("/battery_state"),
      MakeTopic<msg::ControllerInfo>("/controller_heartbeat"),
      MakeTopic<msg::QuadModel>("/quad_model_update"),
      MakeTopic<msg::StateHash>("/scoria/state_hash"),
      MakeTopic<msg::Event>("/scoria/event"),
      MakeTopic<msg::ControllerStart>("/scoria/controller_start"),
      MakeTopic<msg::ControllerInput>("/scoria/controller_input"),
  };
}

/// One per group of the row.
std::vector<Topic> AppendRowTopics(std::vector<Topic> topics) {
  const logs::Row row;
  logs::ForEachGroup(row, [&]<class Group>(const std::optional<Group>&) {
    const bool reproducible = Group::kGroup != logs::RowGroup::kSolveTimes;
    topics.push_back(
        MakeTopic<logs::RowMessage<Group>>(logs::TopicOf(Group::kGroup), reproducible));
  });
  return topics;
}

}  // namespace

const std::vector<Topic>& RecordedTopics() {
  static const std::vector<Topic> kTopics = AppendRowTopics(FixedTopics());
  return kTopics;
}

bool IsLogged(const Topic& topic, const LogParams& params) {
  return params.topics == LogTopics::kAll || topic.of_reference;
}

std::string MissingTopics(const LogParams& params) {
  if (params.topics == LogTopics::kAll) return "";
  return "the log holds the reference's topics alone (log.topics=reference)";
}

Recorder::Recorder(MessageSink& sink, const Scenario& scenario)
    : sink_(sink),
      slow_every_(
          std::max(1, static_cast<int>(std::lround(kHeartbeat_s / scenario.physics.step_s)))) {}

template <class Message>
void Recorder::Write(const Topic& topic, double time_s, Message message) {
  logs::EncodeCdr(message, buffer_);
  sink_.Write(topic, ToNanoseconds(time_s), buffer_);
}

void Recorder::OnRow(const StepRecord& r, const logs::Row& row) {
  RecordSensors(r);
  RecordBody(r);
  if (r.control.mpc_updated) RecordPlans(r);
  if (r.step % slow_every_ == 0) RecordSlow(r);
  std::size_t topic = kFirstRowGroup;
  logs::ForEachGroup(row, [&]<class Group>(const std::optional<Group>& group) {
    if (group)
      Write(RecordedTopics()[topic], r.time_s, logs::RowMessage<Group>{row.time_s, *group});
    ++topic;
  });
}

void Recorder::RecordSensors(const StepRecord& r) {
  const std::vector<Topic>& topics = RecordedTopics();
  msg::JointState joints = MakeJointState(r);
  joints.header = MakeHeader(r.time_s, "");
  Write(topics[kJointStates], r.time_s, joints);
  Write(topics[kImu], r.time_s, MakeImu(r));
  msg::ContactState contact;
  contact.header = MakeHeader(r.time_s, "");
  contact.ground_contact_force = ToArray(r.sensors.foot_force_raw);
  Write(topics[kContactState], r.time_s, contact);
}

/// Command and state, and what the body controller did if it has just run.
void Recorder::RecordBody(const StepRecord& r) {
  const std::vector<Topic>& topics = RecordedTopics();
  Write(topics[kJointCmd], r.time_s, MakeJointCmd(r));
  Write(topics[kQuadState], r.time_s, MakeQuadState(r));
  if (!r.control.wbc_updated) return;
  Write(topics[kWbcTarget], r.time_s, MakeWbcTarget(r));
  msg::WBCReturn wbc;
  wbc.header = MakeHeader(r.time_s, "");
  wbc.success = controller::IsUsable(r.control.wbc_status);
  wbc.total_time = wbc.qp_solve_time = r.control.wbc_solve_s;
  Write(topics[kWbcSolveTime], r.time_s, wbc);
}

/// At the rate of gait and MPC.
void Recorder::RecordPlans(const StepRecord& r) {
  const std::vector<Topic>& topics = RecordedTopics();
  Write(topics[kGaitState], r.time_s, MakeGaitState(r));
  Write(topics[kControlTarget], r.time_s, MakeControlTarget(r));
  Write(topics[kSolveTime], r.time_s, MakeMpcDiagnostics(r));
  msg::BatteryState battery;
  battery.voltage = static_cast<float>(r.battery.voltage_V);
  battery.current = static_cast<float>(r.battery.current_A);
  Write(topics[kBattery], r.time_s, battery);
}

void Recorder::RecordSlow(const StepRecord& r) {
  const std::vector<Topic>& topics = RecordedTopics();
  Write(topics[kHeartbeat], r.time_s, MakeControllerInfo(r));
  const bool learns = r.control.adaptation.mass_kg > 0.0;
  if (learns) Write(topics[kModel], r.time_s, MakeQuadModel(r));
}

void Recorder::OnEvent(const EpisodeEvent& event) {
  const std::string& kind = event.kind;
  Write(RecordedTopics()[kEvent], event.time_s, msg::Event{event.step, kind, event.detail});
  // What replay needs to go on, and what a robot's monitors tell.
  const bool worth_keeping =
      kind != "placed" && kind != "poor_ground" && kind != "contact_source" && kind != "payload";
  if (worth_keeping) sink_.MarkFall(ToNanoseconds(event.time_s));
}

void Recorder::OnStart(double time_s, const controller::Start& start) {
  const controller::Placement& at = start.placement;
  msg::ControllerStart message{start.step,     start.pose == controller::Start::Pose::kStanding,
                               at.p_WB_xy.x(), at.p_WB_xy.y(),
                               at.ground_z_m,  at.yaw_rad};
  Write(RecordedTopics()[kStart], time_s, message);
}

void Recorder::OnStep(const StepRecord& r) {
  Write(RecordedTopics()[kInput], r.time_s, MakeControllerInput(r));
  if (r.state_hash) Write(RecordedTopics()[kHash], r.time_s, msg::StateHash{r.step, *r.state_hash});
}
FileSink::FileSink(const std::filesystem::path& path, const Scenario& scenario,
                   const core::RobotDescription& robot, const logs::LogMetadata& extra)
    : writer_(path), params_(scenario.log) {
  writer_.AddMetadata(kScenarioMetadata, MakeLogMetadata(scenario, robot, extra));
  if (params_.topics == LogTopics::kAll)
    writer_.AddMetadata(logs::kRowMetadata, logs::MakeRowMetadata(kVersion));
  if (const auto heightmap = PackHeightmap(scenario)) writer_.AddAttachment(*heightmap);
  for (const Topic& topic : RecordedTopics()) {
    channels_.emplace_back();
    if (IsLogged(topic, params_))
      channels_.back() = writer_.AddChannel(topic.name, topic.type_name, topic.schema_text);
  }
}

void FileSink::Write(const Topic& topic, std::int64_t time_ns, std::span<const std::byte> message) {
  const std::optional<std::uint16_t> channel =
      channels_[static_cast<std::size_t>(&topic - RecordedTopics().data())];
  if (!channel) return;
  if (params_.keep == KeepLog::kFull || time_ns <= write_until_ns_) {
    writer_.Write(*channel, time_ns, message);
    return;
  }
  held_.push_back({*channel, time_ns, {message.begin(), message.end()}});
  const std::int64_t oldest = time_ns - ToNanoseconds(params_.before_fall_s);
  while (held_.front().time_ns < oldest) held_.pop_front();
}

void FileSink::MarkFall(std::int64_t time_ns) {
  if (params_.keep != KeepLog::kFalls) return;
  for (const Held& held : held_) writer_.Write(held.channel, held.time_ns, held.message);
  held_.clear();
  write_until_ns_ = time_ns + ToNanoseconds(params_.after_fall_s);
}

}  // namespace scoria::app
