// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

/// The groups of a row: each is a message with one Serialize. Absent is std::optional within a
/// group, too: never zero. Legs FL FR HL HR, joints HAA HFE KFE per leg, vectors x y z in W,
/// attitudes roll pitch yaw, unless named otherwise.
namespace scoria::logs {

using Array3 = std::array<double, 3>;
using Array12 = std::array<double, 12>;  // a vector per leg
template <class T>
using PerLeg = std::array<T, 4>;

/// The groups of a row, those first that no sensor of the robot tells.
enum class RowGroup {
  kEpisode,
  kTruth,
  kTrueJoints,
  kTrueContacts,
  kTrueMass,
  kEnergy,
  kLedger,
  kMeasured,
  kCommand,
  kJointCommand,
  kPlan,
  kReference,
  kEstimate,
  kContacts,
  kModel,
  kSupervision,
  kSolveTimes,
};
inline constexpr std::size_t kNumRowGroups = 17;
constexpr std::array<std::pair<RowGroup, std::string_view>, kNumRowGroups> EnumNames(RowGroup) {
  return {{{RowGroup::kEpisode, "episode"},
           {RowGroup::kTruth, "truth"},
           {RowGroup::kTrueJoints, "true_joints"},
           {RowGroup::kTrueContacts, "true_contacts"},
           {RowGroup::kTrueMass, "true_mass"},
           {RowGroup::kEnergy, "energy"},
           {RowGroup::kLedger, "ledger"},
           {RowGroup::kMeasured, "measured"},
           {RowGroup::kCommand, "command"},
           {RowGroup::kJointCommand, "joint_command"},
           {RowGroup::kPlan, "plan"},
           {RowGroup::kReference, "reference"},
           {RowGroup::kEstimate, "estimate"},
           {RowGroup::kContacts, "contacts"},
           {RowGroup::kModel, "model"},
           {RowGroup::kSupervision, "supervision"},
           {RowGroup::kSolveTimes, "solve_times"}}};
}

/// Of what the fields below mean. Raised when one changes its meaning under the same name and type;
/// other changes show in the schema of the group's topic, and leave the other groups readable.
inline constexpr int kRowSchemaVersion = 2;

/// Where the controller is in its episode.
struct EpisodeRow {
  static constexpr RowGroup kGroup = RowGroup::kEpisode;
  static constexpr const char* kTypeName = "scoria_msgs/msg/EpisodeRow";
  std::int64_t step = 0;      // physics step
  bool operating = false;     // the walking controller is in charge
  bool fallen = false;        // from the fall until the robot is set on its feet and walks again
  std::uint32_t segment = 0;  // counts placements: rows of different segments are not one path
  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("operating", operating);
    a("fallen", fallen);
    a("segment", segment);
  }
  bool operator==(const EpisodeRow&) const = default;
};

/// True motion of the trunk: of the simulator, or of a motion capture system.
struct TruthRow {
  static constexpr RowGroup kGroup = RowGroup::kTruth;
  static constexpr const char* kTypeName = "scoria_msgs/msg/TruthRow";
  Array3 p_WB_m{}, v_WB_mps{}, w_WB_radps{}, rpy_rad{};
  std::optional<double> ground_z_m = std::nullopt;  // under the trunk
  template <class Archive>
  void Serialize(Archive& a) {
    a("p_WB_m", p_WB_m);
    a("v_WB_mps", v_WB_mps);
    a("w_WB_radps", w_WB_radps);
    a("rpy_rad", rpy_rad);
    a("ground_z_m", ground_z_m);
  }
  bool operator==(const TruthRow&) const = default;
};

/// True joints; the torque is the motor's, before joint friction.
struct TrueJointsRow {
  static constexpr RowGroup kGroup = RowGroup::kTrueJoints;
  static constexpr const char* kTypeName = "scoria_msgs/msg/TrueJointsRow";
  Array12 q_rad{}, qd_radps{}, tau_Nm{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("q_rad", q_rad);
    a("qd_radps", qd_radps);
    a("tau_Nm", tau_Nm);
  }
  bool operator==(const TrueJointsRow&) const = default;
};

/// True contacts of feet and trunk with the ground. A log of another simulator may have the
/// contacts alone.
struct TrueContactsRow {
  static constexpr RowGroup kGroup = RowGroup::kTrueContacts;
  static constexpr const char* kTypeName = "scoria_msgs/msg/TrueContactsRow";
  std::optional<Array12> p_WF_m = std::nullopt;   // feet
  std::optional<Array12> f_F_W_N = std::nullopt;  // the ground's forces on them
  PerLeg<bool> contact{};
  std::optional<double> trunk_force_N = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("p_WF_m", p_WF_m);
    a("f_F_W_N", f_F_W_N);
    a("contact", contact);
    a("trunk_force_N", trunk_force_N);
  }
  bool operator==(const TrueContactsRow&) const = default;
};

/// True mass of the whole robot, payload included, and its centre.
struct TrueMassRow {
  static constexpr RowGroup kGroup = RowGroup::kTrueMass;
  static constexpr const char* kTypeName = "scoria_msgs/msg/TrueMassRow";
  double mass_kg = 0.0;
  Array3 p_BC_m{};        // in B
  double p_WC_z_m = 0.0;  // height of the centre of mass in W
  template <class Archive>
  void Serialize(Archive& a) {
    a("mass_kg", mass_kg);
    a("p_BC_m", p_BC_m);
    a("p_WC_z_m", p_WC_z_m);
  }
  bool operator==(const TrueMassRow&) const = default;
};

/// What the robot's sensors said.
struct MeasuredRow {
  static constexpr RowGroup kGroup = RowGroup::kMeasured;
  static constexpr const char* kTypeName = "scoria_msgs/msg/MeasuredRow";
  std::optional<Array12> q_rad = std::nullopt, qd_radps = std::nullopt;
  std::optional<Array12> tau_Nm = std::nullopt;  // by the motors' currents
  std::optional<Array3> a_WS_S_mps2 = std::nullopt,
                        w_WS_S_radps = std::nullopt;  // IMU: specific force, rate
  std::optional<Array3> rpy_WS_rad = std::nullopt;    // attitude by the IMU's own filter
  std::optional<PerLeg<double>> foot_force_counts = std::nullopt;  // raw
  std::optional<double> battery_V = std::nullopt, battery_A = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("q_rad", q_rad);
    a("qd_radps", qd_radps);
    a("tau_Nm", tau_Nm);
    a("a_WS_S_mps2", a_WS_S_mps2);
    a("w_WS_S_radps", w_WS_S_radps);
    a("rpy_WS_rad", rpy_WS_rad);
    a("foot_force_counts", foot_force_counts);
    a("battery_V", battery_V);
    a("battery_A", battery_A);
  }
  bool operator==(const MeasuredRow&) const = default;
};

/// What the operator asks for, in the heading frame.
struct CommandRow {
  static constexpr RowGroup kGroup = RowGroup::kCommand;
  static constexpr const char* kTypeName = "scoria_msgs/msg/CommandRow";
  double v_x_mps = 0.0, v_y_mps = 0.0, w_z_radps = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("v_x_mps", v_x_mps);
    a("v_y_mps", v_y_mps);
    a("w_z_radps", w_z_radps);
  }
  bool operator==(const CommandRow&) const = default;
};

/// What the joints were told. Rows of our own walks leave it to /joint_cmd.
struct JointCommandRow {
  static constexpr RowGroup kGroup = RowGroup::kJointCommand;
  static constexpr const char* kTypeName = "scoria_msgs/msg/JointCommandRow";
  std::optional<Array12> q_rad = std::nullopt, qd_radps = std::nullopt;
  std::optional<Array12> tau_Nm = std::nullopt;  // beside the torques of the gains
  std::optional<Array12> kp_Nm_per_rad = std::nullopt, kd_Nms_per_rad = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("q_rad", q_rad);
    a("qd_radps", qd_radps);
    a("tau_Nm", tau_Nm);
    a("kp_Nm_per_rad", kp_Nm_per_rad);
    a("kd_Nms_per_rad", kd_Nms_per_rad);
  }
  bool operator==(const JointCommandRow&) const = default;
};

/// Gait and footholds as planned. Points are in the estimator's frame.
struct PlanRow {
  static constexpr RowGroup kGroup = RowGroup::kPlan;
  static constexpr const char* kTypeName = "scoria_msgs/msg/PlanRow";
  double period_s = 0.0, duty = 0.0;
  PerLeg<double> phase{};
  PerLeg<bool> stance{};
  std::optional<PerLeg<std::uint8_t>> leg_mode = std::nullopt;  // LegMode
  std::optional<Array12> foot_target_m = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("period_s", period_s);
    a("duty", duty);
    a("phase", phase);
    a("stance", stance);
    a("leg_mode", leg_mode);
    a("foot_target_m", foot_target_m);
  }
  bool operator==(const PlanRow&) const = default;
};

/// Where the body should be, in the estimator's frame.
struct ReferenceRow {
  static constexpr RowGroup kGroup = RowGroup::kReference;
  static constexpr const char* kTypeName = "scoria_msgs/msg/ReferenceRow";
  Array3 rpy_rad{}, p_WC_m{}, v_WC_mps{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("rpy_rad", rpy_rad);
    a("p_WC_m", p_WC_m);
    a("v_WC_mps", v_WC_mps);
  }
  bool operator==(const ReferenceRow&) const = default;
};

/// Innovation of a filter's correction by the feet.
struct Innovation {
  static constexpr const char* kTypeName = "scoria_msgs/msg/Innovation";
  double nis = 0.0;  // normalised innovation squared
  std::uint32_t dof = 0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("nis", nis);
    a("dof", dof);
  }
  bool operator==(const Innovation&) const = default;
};

/// Motion of the trunk as the controller estimates it. The estimator's frame starts at the place
/// where the robot was put.
struct EstimateRow {
  static constexpr RowGroup kGroup = RowGroup::kEstimate;
  static constexpr const char* kTypeName = "scoria_msgs/msg/EstimateRow";
  Array3 p_WB_m{}, v_WB_mps{}, rpy_rad{};
  /// Covariance of the tilt about x and y of W [rad] and of the velocity [m/s], both
  /// right-invariant errors: its lower triangle, row by row.
  std::optional<std::array<double, 15>> P_tilt_v = std::nullopt;
  std::optional<Innovation> innovation = std::nullopt;  // of the last correction by the feet
  template <class Archive>
  void Serialize(Archive& a) {
    a("p_WB_m", p_WB_m);
    a("v_WB_mps", v_WB_mps);
    a("rpy_rad", rpy_rad);
    a("P_tilt_v", P_tilt_v);
    a("innovation", innovation);
  }
  bool operator==(const EstimateRow&) const = default;
};

/// Contact by the foot sensors.
struct SensorContact {
  static constexpr const char* kTypeName = "scoria_msgs/msg/SensorContact";
  PerLeg<bool> contact{}, healthy{};
  PerLeg<double> counts{};  // over the threshold
  template <class Archive>
  void Serialize(Archive& a) {
    a("contact", contact);
    a("healthy", healthy);
    a("counts", counts);
  }
  bool operator==(const SensorContact&) const = default;
};

/// Contact by the momentum observer.
struct ObserverContact {
  static constexpr const char* kTypeName = "scoria_msgs/msg/ObserverContact";
  PerLeg<bool> contact{};
  PerLeg<double> probability{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("contact", contact);
    a("probability", probability);
  }
  bool operator==(const ObserverContact&) const = default;
};

/// Contacts as the controller estimates them.
struct ContactsRow {
  static constexpr RowGroup kGroup = RowGroup::kContacts;
  static constexpr const char* kTypeName = "scoria_msgs/msg/ContactsRow";
  PerLeg<bool> contact{};                                     // fused: what the controller acts on
  std::optional<PerLeg<std::uint8_t>> source = std::nullopt;  // ContactSource of it
  std::optional<Array12> f_F_W_N = std::nullopt;              // the ground's forces on the feet
  std::optional<SensorContact> sensor = std::nullopt;
  std::optional<ObserverContact> observer = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("contact", contact);
    a("source", source);
    a("f_F_W_N", f_F_W_N);
    a("sensor", sensor);
    a("observer", observer);
  }
  bool operator==(const ContactsRow&) const = default;
};

/// What an adaptation learned of the whole robot's mass.
struct LearnedModel {
  static constexpr const char* kTypeName = "scoria_msgs/msg/LearnedModel";
  double mass_kg = 0.0;
  std::optional<double> sigma_kg = std::nullopt;
  Array3 p_BC_m{};     // in B
  bool tared = false;  // the readings at the known mass were taken, or none asked for
  template <class Archive>
  void Serialize(Archive& a) {
    a("mass_kg", mass_kg);
    a("sigma_kg", sigma_kg);
    a("p_BC_m", p_BC_m);
    a("tared", tared);
  }
  bool operator==(const LearnedModel&) const = default;
};

/// The model that the controller acts on, and what it learned of it.
struct ModelRow {
  static constexpr RowGroup kGroup = RowGroup::kModel;
  static constexpr const char* kTypeName = "scoria_msgs/msg/ModelRow";
  double used_mass_kg = 0.0;
  std::optional<LearnedModel> learned = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("used_mass_kg", used_mass_kg);
    a("learned", learned);
  }
  bool operator==(const ModelRow&) const = default;
};

/// Energy drawn since the start, metered at the true joints every physics step.
struct EnergyRow {
  static constexpr RowGroup kGroup = RowGroup::kEnergy;
  static constexpr const char* kTypeName = "scoria_msgs/msg/EnergyRow";
  double mech_abs_J = 0.0, mech_pos_J = 0.0, electrical_J = 0.0, battery_J = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("mech_abs_J", mech_abs_J);
    a("mech_pos_J", mech_pos_J);
    a("electrical_J", electrical_J);
    a("battery_J", battery_J);
  }
  bool operator==(const EnergyRow&) const = default;
};

/// Energy ledger since the last placement: works on the robot, and its energy now.
struct LedgerRow {
  static constexpr RowGroup kGroup = RowGroup::kLedger;
  static constexpr const char* kTypeName = "scoria_msgs/msg/LedgerRow";
  double motor_J = 0.0, joint_J = 0.0, contact_J = 0.0, external_J = 0.0;
  double kinetic_J = 0.0, potential_J = 0.0, initial_J = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("motor_J", motor_J);
    a("joint_J", joint_J);
    a("contact_J", contact_J);
    a("external_J", external_J);
    a("kinetic_J", kinetic_J);
    a("potential_J", potential_J);
    a("initial_J", initial_J);
  }
  bool operator==(const LedgerRow&) const = default;
};

/// Quality that each stage reports of itself, 1 as designed to 0 of no use, and on which of them
/// the supervisor has engaged the fallback: MPC, body controller, estimator, contact, footing,
/// load.
struct SupervisionRow {
  static constexpr RowGroup kGroup = RowGroup::kSupervision;
  static constexpr const char* kTypeName = "scoria_msgs/msg/SupervisionRow";
  std::array<double, 6> stage_quality{};
  std::array<bool, 6> fallen_back{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("stage_quality", stage_quality);
    a("fallen_back", fallen_back);
  }
  bool operator==(const SupervisionRow&) const = default;
};

/// Wall-clock times of the solvers, where they ran in the row's tick. No re-run repeats them.
struct SolveTimesRow {
  static constexpr RowGroup kGroup = RowGroup::kSolveTimes;
  static constexpr const char* kTypeName = "scoria_msgs/msg/SolveTimesRow";
  std::optional<double> mpc_s = std::nullopt, wbc_s = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a("mpc_s", mpc_s);
    a("wbc_s", wbc_s);
  }
  bool operator==(const SolveTimesRow&) const = default;
};

}  // namespace scoria::logs
