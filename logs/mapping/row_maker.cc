// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/row_maker.h"

#include "core/math/so3.h"
#include "logs/vectors.h"

namespace scoria::logs {
namespace {

using Instant = StreamJoiner::Instant;
using Id = SignalId;

constexpr double kGravity_mps2 = 9.81;

const std::optional<SignalValues>& Get(const SignalSet& signals, Id id) {
  return signals[static_cast<std::size_t>(id)];
}

std::optional<double> Scalar(const SignalSet& s, Id id) {
  const auto& v = Get(s, id);
  return v ? std::optional((*v)[0]) : std::nullopt;
}
std::optional<Array12> Twelve(const SignalSet& s, Id id) { return Get(s, id); }

Vec3 ToVector(const SignalValues& v) { return {v[0], v[1], v[2]}; }
Mat3 ToRotation(const SignalValues& q) {
  return Quat(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}
std::optional<Array3> Vector(const SignalSet& s, Id id) {
  const auto& v = Get(s, id);
  return v ? std::optional(Array3{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}
std::optional<Array3> Rpy(const SignalSet& s, Id id) {
  const auto& v = Get(s, id);
  return v ? std::optional(ToArray(core::RpyFromRotation(ToRotation(*v)))) : std::nullopt;
}
template <class T>
std::optional<PerLeg<T>> Legs(const SignalSet& s, Id id) {
  const auto& v = Get(s, id);
  if (!v) return std::nullopt;
  PerLeg<T> out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    if constexpr (std::is_same_v<T, bool>) {
      out[k] = (*v)[k] != 0.0;
    } else {
      out[k] = (*v)[k];
    }
  }
  return out;
}

/// A signal before and after a row; at the ends of the log and beside gaps the row is one of them.
struct Neighbours {
  SignalValues before{}, after{};
  double between_s = 0.0;
};

std::optional<Neighbours> NeighboursOf(const Instant& instant, Id id) {
  const std::int64_t half_ns = instant.derivative_ns(id);
  const auto now = instant.At(id), before = instant.At(id, -half_ns),
             after = instant.At(id, half_ns);
  if (!now || (!before && !after) || half_ns == 0) return std::nullopt;
  const double half_s = 1e-9 * static_cast<double>(half_ns);
  return Neighbours{before.value_or(*now), after.value_or(*now),
                    before && after ? 2.0 * half_s : half_s};
}

/// The derivative of a position.
std::optional<Vec3> Derivative(const Instant& instant, Id id) {
  const auto n = NeighboursOf(instant, id);
  if (!n) return std::nullopt;
  return (ToVector(n->after) - ToVector(n->before)) / n->between_s;
}

/// Angular velocity in W from an attitude.
std::optional<Vec3> AngularDerivative(const Instant& instant, Id id) {
  const auto n = NeighboursOf(instant, id);
  if (!n) return std::nullopt;
  return core::LogSo3(ToRotation(n->after) * ToRotation(n->before).transpose()) / n->between_s;
}

Vec3 InWorld(const SignalValues& v, VectorFrame frame, const Mat3& R_WB) {
  return frame == VectorFrame::kWorld ? ToVector(v) : R_WB * ToVector(v);
}

/// Of the trunk: what a velocity is that the mapping does not name.
template <class Section>
std::optional<Vec3> VelocityOf(const Section& section, const Instant& instant, const SignalSet& s,
                               Id position, Id velocity, const Mat3& R_WB) {
  if (!section.velocity) return Derivative(instant, position);
  const auto& v = Get(s, velocity);
  return v ? std::optional(InWorld(*v, section.velocity->frame, R_WB)) : std::nullopt;
}

std::optional<CommandRow> MakeCommand(const SignalSet& s) {
  const auto v_x = Scalar(s, Id::kCommandVx), v_y = Scalar(s, Id::kCommandVy),
             w_z = Scalar(s, Id::kCommandWz);
  if (!v_x || !v_y || !w_z) return std::nullopt;
  return CommandRow{*v_x, *v_y, *w_z};
}

std::optional<JointCommandRow> MakeJointCommand(const SignalSet& s) {
  JointCommandRow row;
  row.q_rad = Twelve(s, Id::kJointCommandQ);
  row.qd_radps = Twelve(s, Id::kJointCommandQd);
  row.tau_Nm = Twelve(s, Id::kJointCommandTau);
  row.kp_Nm_per_rad = Twelve(s, Id::kJointCommandKp);
  row.kd_Nms_per_rad = Twelve(s, Id::kJointCommandKd);
  return row == JointCommandRow{} ? std::nullopt : std::optional(row);
}

std::optional<PlanRow> MakePlan(const SignalSet& s) {
  const auto period = Scalar(s, Id::kPlanPeriod), duty = Scalar(s, Id::kPlanDuty);
  const auto phase = Legs<double>(s, Id::kPlanPhase);
  const auto stance = Legs<bool>(s, Id::kPlanStance);
  if (!period || !duty || !phase || !stance) return std::nullopt;
  PlanRow row;
  row.period_s = *period;
  row.duty = *duty;
  row.phase = *phase;
  row.stance = *stance;
  row.foot_target_m = Twelve(s, Id::kPlanFootTarget);
  return row;
}

std::optional<ReferenceRow> MakeReference(const SignalSet& s) {
  const auto p = Vector(s, Id::kReferencePosition), v = Vector(s, Id::kReferenceVelocity),
             rpy = Rpy(s, Id::kReferenceAttitude);
  if (!p || !v || !rpy) return std::nullopt;
  return ReferenceRow{*rpy, *p, *v};
}

std::optional<ModelRow> MakeModel(const SignalSet& s) {
  const auto mass = Scalar(s, Id::kModelMass);
  if (!mass) return std::nullopt;
  ModelRow row;
  row.used_mass_kg = *mass;
  if (const auto com = Vector(s, Id::kModelCom)) row.learned = {*mass, std::nullopt, *com, true};
  return row;
}

std::optional<SolveTimesRow> MakeSolveTimes(const SignalSet& s) {
  const SolveTimesRow row{Scalar(s, Id::kMpcTime), Scalar(s, Id::kWbcTime)};
  return row == SolveTimesRow{} ? std::nullopt : std::optional(row);
}

}  // namespace

RowMaker::RowMaker(const MappingFile& file, const std::map<std::string, LogMetadata>& metadata)
    : file_(file) {
  for (const auto& [name, entries] : metadata) {
    const auto frame = entries.find("contact_force_frame");
    metadata_say_world_ |= frame != entries.end() && frame->second == "W";
  }
}

std::optional<TruthRow> RowMaker::MakeTruth(const Instant& instant, const SignalSet& s) const {
  const auto& p = Get(s, Id::kTruthPosition);
  const auto& q = Get(s, Id::kTruthAttitude);
  if (!p || !q) return std::nullopt;
  const TruthSection& section = *file_.truth;
  const Mat3 R_WB = ToRotation(*q);
  const std::optional<Vec3> v =
      VelocityOf(section, instant, s, Id::kTruthPosition, Id::kTruthVelocity, R_WB);
  std::optional<Vec3> w;
  const auto& rate = Get(s, Id::kTruthRate);
  if (!section.rate) w = AngularDerivative(instant, Id::kTruthAttitude);
  if (section.rate && rate) w = InWorld(*rate, section.rate->frame, R_WB);
  if (!v || !w) return std::nullopt;
  const Vec3 p_BM_W = R_WB * Vec3(section.p_BM_m[0], section.p_BM_m[1], section.p_BM_m[2]);
  TruthRow row;
  row.p_WB_m = ToArray(ToVector(*p) - p_BM_W);
  row.v_WB_mps = ToArray(*v - w->cross(p_BM_W));
  row.w_WB_radps = ToArray(*w);
  row.rpy_rad = ToArray(core::RpyFromRotation(R_WB));
  return row;
}

std::optional<EstimateRow> RowMaker::MakeEstimate(const Instant& instant,
                                                  const SignalSet& s) const {
  const auto& p = Get(s, Id::kEstimatePosition);
  const auto& q = Get(s, Id::kEstimateAttitude);
  if (!p || !q) return std::nullopt;
  const Mat3 R_WB = ToRotation(*q);
  const std::optional<Vec3> v =
      VelocityOf(*file_.estimate, instant, s, Id::kEstimatePosition, Id::kEstimateVelocity, R_WB);
  if (!v) return std::nullopt;
  EstimateRow row;
  row.p_WB_m = ToArray(ToVector(*p));
  row.v_WB_mps = ToArray(*v);
  row.rpy_rad = ToArray(core::RpyFromRotation(R_WB));
  return row;
}

std::optional<MeasuredRow> RowMaker::MakeMeasured(const SignalSet& s) const {
  MeasuredRow row;
  row.q_rad = Twelve(s, Id::kJointQ);
  row.qd_radps = Twelve(s, Id::kJointQd);
  row.tau_Nm = Twelve(s, Id::kJointTau);
  row.w_WS_S_radps = Vector(s, Id::kImuRate);
  row.rpy_WS_rad = Rpy(s, Id::kImuAttitude);
  row.foot_force_counts = Legs<double>(s, Id::kFootForce);
  row.battery_V = Scalar(s, Id::kBatteryVoltage);
  row.battery_A = Scalar(s, Id::kBatteryCurrent);
  row.a_WS_S_mps2 = Vector(s, Id::kImuAcceleration);
  const bool lacks_gravity = row.a_WS_S_mps2 && file_.imu && file_.imu->acceleration &&
                             file_.imu->acceleration->gravity == Gravity::kRemoved;
  if (lacks_gravity) {
    const SignalValues* q = nullptr;
    for (const Id id : {Id::kImuAttitude, Id::kEstimateAttitude, Id::kTruthAttitude}) {
      if (q == nullptr && Get(s, id)) q = &*Get(s, id);
    }
    const Vec3 g_W(0.0, 0.0, kGravity_mps2);
    const auto& a = *row.a_WS_S_mps2;
    row.a_WS_S_mps2 =
        q == nullptr
            ? std::nullopt
            : std::optional(ToArray(Vec3(a[0], a[1], a[2]) + ToRotation(*q).transpose() * g_W));
  }
  return row == MeasuredRow{} ? std::nullopt : std::optional(row);
}

/// Absent where they are in the body's frame and its attitude is not known.
std::optional<Array12> RowMaker::ForcesInWorld(const std::optional<SignalValues>& forces,
                                               ForceFrame frame,
                                               const std::optional<Array3>& rpy_rad) const {
  const bool in_world =
      frame == ForceFrame::kWorld || (frame == ForceFrame::kMetadata && metadata_say_world_);
  if (!forces || in_world) return forces;
  if (!rpy_rad) return std::nullopt;
  const Mat3 R_WB = core::RotationFromRpy({(*rpy_rad)[0], (*rpy_rad)[1], (*rpy_rad)[2]});
  Array12 out{};
  for (std::size_t k = 0; k < 12; k += 3) {
    const Vec3 f_W = R_WB * Vec3((*forces)[k], (*forces)[k + 1], (*forces)[k + 2]);
    for (std::size_t j = 0; j < 3; ++j) out[k + j] = f_W[static_cast<Eigen::Index>(j)];
  }
  return out;
}

Row RowMaker::Make(double time_s, const Instant& instant, const SignalSet& s) const {
  Row row;
  row.time_s = time_s;
  row.truth = MakeTruth(instant, s);
  row.estimate = MakeEstimate(instant, s);
  row.measured = MakeMeasured(s);
  row.command = MakeCommand(s);
  row.joint_command = MakeJointCommand(s);
  row.plan = MakePlan(s);
  row.reference = MakeReference(s);
  row.model = MakeModel(s);
  row.solve_times = MakeSolveTimes(s);
  const auto rpy_of = [](const auto& group) {
    return group ? std::optional(group->rpy_rad) : std::nullopt;
  };
  if (const auto contact = Legs<bool>(s, Id::kContact)) {
    row.contacts.emplace().contact = *contact;
    const auto& force = file_.contacts->force;
    row.contacts->f_F_W_N =
        ForcesInWorld(Get(s, Id::kContactForce), force ? force->frame : ForceFrame::kWorld,
                      row.estimate ? rpy_of(row.estimate) : Rpy(s, Id::kImuAttitude));
  }
  if (const auto contact = Legs<bool>(s, Id::kTrueContact)) {
    row.true_contacts.emplace().contact = *contact;
    const auto& force = file_.true_contacts->force;
    row.true_contacts->f_F_W_N = ForcesInWorld(
        Get(s, Id::kTrueForce), force ? force->frame : ForceFrame::kWorld, rpy_of(row.truth));
    row.true_contacts->p_WF_m = Twelve(s, Id::kTrueFootPosition);
  }
  return row;
}

}  // namespace scoria::logs
