// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "logs/mapping/field_source.h"

/// The keys of a mapping file (docs/mappings.md). Sections are what a robot or a program says in
/// one kind of message; signals of a section may be in other topics.
namespace scoria::logs {

/// A topic, or a CSV file, by what it is known.
struct TopicSpec {
  std::string type;
  std::vector<std::string> names;
  std::uint64_t columns = 0;
  bool optional = false;
  std::optional<double> max_age_s = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("type", type, {.doc = "of its messages, as unitree_go/msg/LowState"});
    a.Field(
        "names", names,
        {.doc = "that it may have, the likeliest first; none: any, if it is the only one of its "
                "type. Of a CSV file its name without the extension"});
    a.Field("columns", columns, {.doc = "of a CSV file; 0: any number"});
    a.Field("optional", optional, {.doc = "a log without it is mapped without what it holds"});
    a.Field("max_age_s", max_age_s,
            {.min = 0.0, .doc = "a sample older than that is absent from a row; none: 3 periods"});
  }
};

/// Numbers for HAA, HFE, KFE of each leg, the special over the general.
struct PerJoint {
  using Three = std::optional<std::array<double, 3>>;
  Three all, front, hind, left, right, FL, FR, HL, HR;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("all", all, {.doc = "of HAA, HFE, KFE in every leg"});
    a.Field("front", front);
    a.Field("hind", hind);
    a.Field("left", left);
    a.Field("right", right);
    a.Field("FL", FL);
    a.Field("FR", FR);
    a.Field("HL", HL);
    a.Field("HR", HR);
  }
};

enum class JointOrder { kByLeg, kByJoint };
constexpr UnitNames<JointOrder, 2> EnumNames(JointOrder) {
  return {{{JointOrder::kByLeg, "by_leg"}, {JointOrder::kByJoint, "by_joint"}}};
}

/// Measured joints, and the conventions that commands share with them.
struct JointsSection {
  std::string topic;
  std::optional<Source<AngleUnit>> q;
  std::optional<Source<RateUnit>> qd;
  std::optional<Source<TorqueUnit>> tau;
  std::array<std::string, 3> names = {"hip", "thigh", "calf"};
  JointOrder order = JointOrder::kByLeg;
  std::string name_field;
  PerJoint sign, zero_rad;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("q", q, {.doc = "angles"});
    a.Field("qd", qd, {.doc = "rates"});
    a.Field("tau", tau, {.doc = "torques"});
    a.Field("names", names, {.doc = "{joint}: what the log calls HAA, HFE, KFE"});
    a.Field(
        "order", order,
        {.doc = "of arrays of twelve: by_leg, a leg's three joints together; by_joint, the four "
                "HAA together"});
    a.Field(
        "name_field", name_field,
        {.doc = "texts that name the joints of the arrays beside them, in any order, as name of "
                "sensor_msgs/msg/JointState"});
    a.Field("sign", sign, {.doc = "angle = sign * log's + zero; rates and torques: sign"});
    a.Field("zero_rad", zero_rad, {.doc = "our angle where the log says 0"});
  }
};

/// What the joints were told.
struct JointCommandSection {
  std::string topic;
  std::optional<Source<AngleUnit>> q;
  std::optional<Source<RateUnit>> qd;
  std::optional<Source<TorqueUnit>> tau;
  std::optional<PlainSource> kp, kd;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("q", q, {.doc = "angles"});
    a.Field("qd", qd, {.doc = "rates"});
    a.Field("tau", tau, {.doc = "torques beside those of the gains"});
    a.Field("kp", kp, {.doc = "Nm/rad"});
    a.Field("kd", kd, {.doc = "Nm s/rad"});
  }
};

struct ImuSection {
  std::string topic;
  std::optional<AttitudeSource> attitude;
  std::optional<VectorSource<RateUnit>> rate;
  std::optional<AccelerationSource> acceleration;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("attitude", attitude, {.doc = "by the IMU's own filter"});
    a.Field("rate", rate, {.doc = "in the IMU's axes"});
    a.Field("acceleration", acceleration, {.doc = "in the IMU's axes"});
  }
};

struct FeetSection {
  std::string topic;
  std::optional<PlainSource> force;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("force", force, {.doc = "of the foot sensors, counts"});
  }
};

struct BatterySection {
  std::string topic;
  std::optional<Source<VoltageUnit>> voltage;
  std::optional<Source<CurrentUnit>> current;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("voltage", voltage);
    a.Field("current", current, {.doc = "drawn: positive"});
  }
};

/// Motion of the trunk as the robot estimates it.
struct EstimateSection {
  std::string topic;
  std::optional<VectorSource<LengthUnit>> position;
  std::optional<FramedSource<SpeedUnit>> velocity;
  std::optional<AttitudeSource> attitude;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("position", position);
    a.Field("velocity", velocity, {.doc = "none: the derivative of the position"});
    a.Field("attitude", attitude);
  }
};

enum class TruthBody { kTrunk, kMarkers };
constexpr UnitNames<TruthBody, 2> EnumNames(TruthBody) {
  return {{{TruthBody::kTrunk, "trunk"}, {TruthBody::kMarkers, "markers"}}};
}

/// True motion of the trunk: of a simulator, or by motion capture.
struct TruthSection {
  std::string topic;
  TruthBody body = TruthBody::kTrunk;
  std::array<double, 3> p_BM_m{};
  std::optional<VectorSource<LengthUnit>> position;
  std::optional<FramedSource<SpeedUnit>> velocity;
  std::optional<FramedSource<RateUnit>> rate;
  std::optional<AttitudeSource> attitude;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("body", body,
            {.doc = "markers: a body of markers on the trunk, not the trunk's frame"});
    a.Field("p_BM_m", p_BM_m, {.doc = "where the markers' origin is in the trunk, if it is known"});
    a.Field("position", position);
    a.Field("velocity", velocity, {.doc = "none: the derivative of the position"});
    a.Field("rate", rate, {.doc = "none: the derivative of the attitude"});
    a.Field("attitude", attitude);
  }
};

/// True contacts of the feet.
struct TrueContactsSection {
  std::string topic;
  std::optional<ContactFlagSource> contact;
  std::optional<ForceSource> force;
  std::optional<Source<LengthUnit>> position;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("contact", contact, {.doc = "which feet bear weight"});
    a.Field("force", force, {.doc = "of the ground on the feet, N"});
    a.Field("position", position, {.doc = "of the feet, in the world"});
  }
};

/// What the operator asks for, in the heading frame.
struct CommandSection {
  std::string topic;
  std::optional<Source<SpeedUnit>> v_x, v_y;
  std::optional<Source<RateUnit>> w_z;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("v_x", v_x, {.doc = "forwards"});
    a.Required("v_y", v_y, {.doc = "to the left"});
    a.Required("w_z", w_z, {.doc = "to the left"});
  }
};

/// Gait and footholds as planned.
struct PlanSection {
  std::string topic;
  std::optional<Source<TimeUnit>> period;
  std::optional<PlainSource> duty, phase, stance;
  std::optional<Source<LengthUnit>> foot_target;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("period", period, {.doc = "of the gait"});
    a.Required("duty", duty, {.doc = "stance share of the period"});
    a.Required("phase", phase, {.doc = "of each leg, 0 to 1"});
    a.Required("stance", stance, {.doc = "which legs shall stand"});
    a.Field("foot_target", foot_target, {.doc = "where the feet shall be, in the world"});
  }
};

/// Where the body should be.
struct ReferenceSection {
  std::string topic;
  std::optional<VectorSource<LengthUnit>> position;
  std::optional<VectorSource<SpeedUnit>> velocity;
  std::optional<AttitudeSource> attitude;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("position", position);
    a.Required("velocity", velocity, {.doc = "in the world"});
    a.Required("attitude", attitude);
  }
};

/// Contacts as the robot estimates them.
struct ContactsSection {
  std::string topic;
  std::optional<ContactFlagSource> contact;
  std::optional<ForceSource> force;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("contact", contact, {.doc = "which feet bear weight"});
    a.Field("force", force, {.doc = "of the ground on the feet, N"});
  }
};

/// The model that the controller acts on.
struct ModelSection {
  std::string topic;
  std::optional<Source<MassUnit>> mass;
  std::optional<VectorSource<LengthUnit>> com;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Required("mass", mass, {.doc = "of the whole robot"});
    a.Field("com", com, {.doc = "of the whole robot, in the trunk"});
  }
};

/// Wall-clock times of the solvers; each in the first row at or after its message.
struct SolveTimesSection {
  std::string topic;
  std::optional<Source<TimeUnit>> mpc, wbc;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("topic", topic, {.doc = "a name of topics, or of the log"});
    a.Field("mpc", mpc);
    a.Field("wbc", wbc);
  }
};

enum class ClockChoice { kAuto, kReceive, kHeader, kCounter, kRow };
constexpr UnitNames<ClockChoice, 5> EnumNames(ClockChoice) {
  return {{{ClockChoice::kAuto, "auto"},
           {ClockChoice::kReceive, "receive"},
           {ClockChoice::kHeader, "header"},
           {ClockChoice::kCounter, "counter"},
           {ClockChoice::kRow, "row"}}};
}

/// Where the time of a message comes from.
struct TimeSection {
  ClockChoice clock = ClockChoice::kAuto;
  std::string stamp, counter;
  TimeUnit stamp_unit = TimeUnit::kS;
  double counter_period_s = 0.001, row_period_s = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("clock", clock,
            {.doc = "auto: the most regular of receive, header and counter; receive: when it was "
                    "recorded; row: number of the message"});
    a.Field("stamp", stamp, {.doc = "field of the header clock; none: header.stamp or stamp"});
    a.Field("stamp_unit", stamp_unit, {.doc = "of a stamp that is a number"});
    a.Field("counter", counter, {.doc = "field of the counter clock, as tick"});
    a.Field("counter_period_s", counter_period_s, {.min = 1e-9, .doc = "of one count"});
    a.Field("row_period_s", row_period_s,
            {.min = 0.0, .doc = "from message to message, where they carry no time"});
  }
};

/// A mapping file.
struct MappingFile {
  std::string name, doc;
  std::filesystem::path robot;
  std::array<std::string, 4> legs = {"FL", "FR", "HL", "HR"};
  std::optional<std::array<std::string, 4>> leg_names;
  std::map<std::string, TopicSpec> topics;
  TimeSection time;
  std::string base_topic;
  JointsSection joints;
  std::optional<ImuSection> imu;
  std::optional<FeetSection> feet;
  std::optional<BatterySection> battery;
  std::optional<JointCommandSection> joint_command;
  std::optional<EstimateSection> estimate;
  std::optional<TruthSection> truth;
  std::optional<TrueContactsSection> true_contacts;
  std::optional<CommandSection> command;
  std::optional<PlanSection> plan;
  std::optional<ReferenceSection> reference;
  std::optional<ContactsSection> contacts;
  std::optional<ModelSection> model;
  std::optional<SolveTimesSection> solve_times;

  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("name", name, {.doc = "none: the file's"});
    a.Field("doc", doc, {.doc = "what logs it is for"});
    a.Field("robot", robot, {.doc = "its file, if it is one robot's"});
    a.Field("legs", legs,
            {.doc = "in the order of the log's arrays: FL FR HL HR, or as the log "
                    "calls them: LF, RR, front_left, br ..."});
    a.Field("leg_names", leg_names,
            {.doc = "{leg}: what the log calls them, in the order of legs; none: as in legs"});
    a.Field("topics", topics, {.doc = "that the log must have, by a name for the sections"});
    a.Field("time", time);
    a.Field("base_topic", base_topic,
            {.doc = "each message of it is a row; none: that of joints.q, "
                    "or of the first signal there is"});
    a.Field("joints", joints);
    a.Field("imu", imu);
    a.Field("feet", feet);
    a.Field("battery", battery);
    a.Field("joint_command", joint_command);
    a.Field("estimate", estimate);
    a.Field("truth", truth);
    a.Field("true_contacts", true_contacts);
    a.Field("command", command);
    a.Field("plan", plan);
    a.Field("reference", reference);
    a.Field("contacts", contacts);
    a.Field("model", model);
    a.Field("solve_times", solve_times);
  }
};

}  // namespace scoria::logs
