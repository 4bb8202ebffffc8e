// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/signal_spec.h"

#include <algorithm>

#include <fmt/format.h>

#include "logs/mapping/vocabulary.h"

namespace scoria::logs {
namespace {

using Id = SignalId;

constexpr std::size_t Index(Leg leg) { return static_cast<std::size_t>(leg); }

/// The axis of a text such as "-y": 0 to 2, and its sign.
struct Axis {
  std::size_t index = 0;
  double sign = 1.0;
};

std::optional<Axis> ParseAxis(std::string text) {
  Axis axis;
  if (text.starts_with('-')) axis.sign = -1.0;
  if (text.starts_with('-') || text.starts_with('+')) text.erase(0, 1);
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  axis.index = static_cast<std::size_t>(text[0] - 'x');
  return axis;
}

/// What is wrong with the axes of a vector, empty if nothing: they must be a right-handed or a
/// mirrored set of three different ones.
std::string AxesProblem(const std::array<std::string, 3>& axes) {
  std::array<bool, 3> seen{};
  for (const std::string& text : axes) {
    const std::optional<Axis> axis = ParseAxis(text);
    if (!axis) return fmt::format("\"{}\" is none of x, y, z, -x, -y, -z", text);
    seen[axis->index] = true;
  }
  if (seen[0] && seen[1] && seen[2]) return "";
  return "names an axis twice";
}

/// Calls visit(key, topic, source) for a signal, and for a section's, if they are there.
template <class Visit>
class SourceVisitor {
 public:
  explicit SourceVisitor(Visit& visit) : visit_(visit) {}
  template <class Source>
  void Add(SignalId id, const std::string& topic, Source& source) const {
    if (source) visit_(id, topic, *source);
  }
  template <class Section, class Use>
  void In(Section& section, Use&& use) const {
    if (section) use(*section);
  }

 private:
  Visit& visit_;
};

/// What was sensed and estimated, by the robot or beside it.
template <class File, class Visitor>
void VisitMeasuredSources(File& f, const Visitor& v) {
  v.Add(Id::kJointQ, f.joints.topic, f.joints.q);
  v.Add(Id::kJointQd, f.joints.topic, f.joints.qd);
  v.Add(Id::kJointTau, f.joints.topic, f.joints.tau);
  v.In(f.imu, [&](auto& s) {
    v.Add(Id::kImuAttitude, s.topic, s.attitude);
    v.Add(Id::kImuRate, s.topic, s.rate);
    v.Add(Id::kImuAcceleration, s.topic, s.acceleration);
  });
  v.In(f.feet, [&](auto& s) { v.Add(Id::kFootForce, s.topic, s.force); });
  v.In(f.battery, [&](auto& s) {
    v.Add(Id::kBatteryVoltage, s.topic, s.voltage);
    v.Add(Id::kBatteryCurrent, s.topic, s.current);
  });
  v.In(f.joint_command, [&](auto& s) {
    v.Add(Id::kJointCommandQ, s.topic, s.q);
    v.Add(Id::kJointCommandQd, s.topic, s.qd);
    v.Add(Id::kJointCommandTau, s.topic, s.tau);
    v.Add(Id::kJointCommandKp, s.topic, s.kp);
    v.Add(Id::kJointCommandKd, s.topic, s.kd);
  });
  v.In(f.estimate, [&](auto& s) {
    v.Add(Id::kEstimatePosition, s.topic, s.position);
    v.Add(Id::kEstimateVelocity, s.topic, s.velocity);
    v.Add(Id::kEstimateAttitude, s.topic, s.attitude);
  });
  v.In(f.truth, [&](auto& s) {
    v.Add(Id::kTruthPosition, s.topic, s.position);
    v.Add(Id::kTruthVelocity, s.topic, s.velocity);
    v.Add(Id::kTruthRate, s.topic, s.rate);
    v.Add(Id::kTruthAttitude, s.topic, s.attitude);
  });
  v.In(f.true_contacts, [&](auto& s) {
    v.Add(Id::kTrueContact, s.topic, s.contact);
    v.Add(Id::kTrueForce, s.topic, s.force);
    v.Add(Id::kTrueFootPosition, s.topic, s.position);
  });
}

/// What was wanted, planned and concluded.
template <class File, class Visitor>
void VisitControlSources(File& f, const Visitor& v) {
  v.In(f.command, [&](auto& s) {
    v.Add(Id::kCommandVx, s.topic, s.v_x);
    v.Add(Id::kCommandVy, s.topic, s.v_y);
    v.Add(Id::kCommandWz, s.topic, s.w_z);
  });
  v.In(f.plan, [&](auto& s) {
    v.Add(Id::kPlanPeriod, s.topic, s.period);
    v.Add(Id::kPlanDuty, s.topic, s.duty);
    v.Add(Id::kPlanPhase, s.topic, s.phase);
    v.Add(Id::kPlanStance, s.topic, s.stance);
    v.Add(Id::kPlanFootTarget, s.topic, s.foot_target);
  });
  v.In(f.reference, [&](auto& s) {
    v.Add(Id::kReferencePosition, s.topic, s.position);
    v.Add(Id::kReferenceVelocity, s.topic, s.velocity);
    v.Add(Id::kReferenceAttitude, s.topic, s.attitude);
  });
  v.In(f.contacts, [&](auto& s) {
    v.Add(Id::kContact, s.topic, s.contact);
    v.Add(Id::kContactForce, s.topic, s.force);
  });
  v.In(f.model, [&](auto& s) {
    v.Add(Id::kModelMass, s.topic, s.mass);
    v.Add(Id::kModelCom, s.topic, s.com);
  });
  v.In(f.solve_times, [&](auto& s) {
    v.Add(Id::kMpcTime, s.topic, s.mpc);
    v.Add(Id::kWbcTime, s.topic, s.wbc);
  });
}

/// Calls visit(key, topic, source) for every signal of a file that is there, with the section's
/// topic.
template <class File, class Visit>
void ForEachSource(File& f, Visit&& visit) {
  const SourceVisitor visitor(visit);
  VisitMeasuredSources(f, visitor);
  VisitControlSources(f, visitor);
}

/// The three numbers that hold for a leg.
std::array<double, 3> ForLeg(const PerJoint& values, Leg leg, double otherwise) {
  std::array<double, 3> out = {otherwise, otherwise, otherwise};
  const auto lay = [&](const PerJoint::Three& some) {
    if (some) out = *some;
  };
  lay(values.all);
  lay(IsFront(leg) ? values.front : values.hind);
  lay(IsLeft(leg) ? values.left : values.right);
  const std::array legs = {&values.FL, &values.FR, &values.HL, &values.HR};
  lay(*legs[Index(leg)]);
  return out;
}

/// Makes specs of the sources of one file.
class SpecMaker {
 public:
  explicit SpecMaker(const MappingFile& file) : file_(file), legs_(LegsOf(file)) {}

  template <class AnySource>
  [[nodiscard]] SignalSpec Make(SignalId id, const std::string& topic, const AnySource& source) {
    SignalSpec spec;
    spec.id = id;
    spec.source = source;
    spec.topic = source.topic.empty() ? topic : source.topic;
    double unit = 1.0;
    if constexpr (requires { ToSi(source.unit); }) unit = ToSi(source.unit);
    spec.gain.fill(unit * source.scale);
    for (std::size_t k = 0; k < 12; ++k) spec.from[k] = k;
    AddOrder(spec);
    if constexpr (requires { source.axes; }) AddAxes(source.axes, spec);
    if constexpr (requires { source.form; }) {
      spec.is_rpy = source.form == AttitudeForm::kRpy;
      spec.order = source.order;
    }
    if constexpr (requires { source.above; }) spec.above = source.above;
    return spec;
  }

 private:
  /// From the log's order of legs and joints to ours.
  void AddOrder(SignalSpec& spec) const {
    const SignalShape shape = TraitsOf(spec.id).shape;
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t leg = Index(legs_[place]);
      if (shape == SignalShape::kPerLeg) spec.from[leg] = place;
      for (std::size_t j = 0; j < 3; ++j) {
        const bool by_joint =
            shape == SignalShape::kPerJoint && file_.joints.order == JointOrder::kByJoint;
        const std::size_t at = by_joint ? 4 * j + place : 3 * place + j;
        if (SizeOf(shape) == 12) spec.from[3 * leg + j] = at;
      }
    }
    if (shape == SignalShape::kPerJoint) AddConvention(spec);
  }

  void AddConvention(SignalSpec& spec) const {
    const bool is_measured = spec.id <= SignalId::kJointTau;
    if (is_measured) spec.name_field = file_.joints.name_field;
    const bool is_angle = spec.id == SignalId::kJointQ || spec.id == SignalId::kJointCommandQ;
    const bool is_gain =
        spec.id == SignalId::kJointCommandKp || spec.id == SignalId::kJointCommandKd;
    if (is_gain) return;
    for (const Leg leg : kLegs) {
      const auto sign = ForLeg(file_.joints.sign, leg, 1.0);
      const auto zero = ForLeg(file_.joints.zero_rad, leg, 0.0);
      for (std::size_t j = 0; j < 3; ++j) {
        spec.gain[3 * Index(leg) + j] *= sign[j];
        if (is_angle) spec.offset[3 * Index(leg) + j] = zero[j];
      }
    }
  }

  static void AddAxes(const std::array<std::string, 3>& axes, SignalSpec& spec) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Axis axis = ParseAxis(axes[k]).value();
      spec.from[k] = axis.index;
      spec.gain[k] *= axis.sign;
    }
  }

  const MappingFile& file_;
  std::array<Leg, 4> legs_;
};

std::optional<FileProblem> LegsProblem(const MappingFile& file) {
  std::array<bool, 4> seen{};
  for (const std::string& name : file.legs) {
    const std::optional<Leg> leg = LegNamed(name);
    if (!leg)
      return FileProblem{"legs", fmt::format("\"{}\" is no leg; FL, FR, HL, HR are, as LF, RR, br "
                                             "or front_left: what else the log calls them stands "
                                             "in leg_names",
                                             name)};
    if (seen[Index(*leg)])
      return FileProblem{"legs", fmt::format("\"{}\" is a leg that is named before", name)};
    seen[Index(*leg)] = true;
  }
  return std::nullopt;
}

}  // namespace

std::array<Leg, 4> LegsOf(const MappingFile& file) {
  std::array<Leg, 4> legs{};
  std::transform(file.legs.begin(), file.legs.end(), legs.begin(),
                 [](const std::string& name) { return LegNamed(name).value(); });
  return legs;
}

std::optional<FileProblem> FindProblem(const MappingFile& file) {
  if (auto problem = LegsProblem(file)) return problem;
  std::optional<FileProblem> problem;
  bool has_signal = false;
  ForEachSource(file, [&](SignalId id, const std::string&, const auto& source) {
    has_signal = true;
    const std::string key(TraitsOf(id).key);
    if constexpr (requires { source.axes; }) {
      const std::string rule = AxesProblem(source.axes);
      if (!problem && !rule.empty()) problem = {key + ".axes", rule};
    }
    const std::size_t size = SizeOf(TraitsOf(id).shape);
    std::size_t wanted = size;
    if constexpr (requires { source.form; }) wanted = source.form == AttitudeForm::kRpy ? 3 : size;
    const std::size_t given = source.fields.size();
    if (!problem && given > 0 && given != wanted)
      problem = {key + ".fields", fmt::format("has {} fields, not {}", given, wanted)};
  });
  if (!problem && !has_signal) problem = {"", "maps no signal"};
  return problem;
}

std::vector<SignalSpec> ListSignals(const MappingFile& file) {
  std::vector<SignalSpec> specs;
  SpecMaker maker(file);
  ForEachSource(file, [&](SignalId id, const std::string& topic, const auto& source) {
    specs.push_back(maker.Make(id, topic, source));
  });
  return specs;
}

}  // namespace scoria::logs
