// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/field/fall_clues.h"
#include "analysis/field/joint_speed.h"
#include "analysis/field/posture.h"
#include "analysis/field/velocity_smoother.h"
#include "analysis/signals/falls.h"
#include "core/robot/description.h"
#include "core/robot/whole_body.h"
#include "logs/quality/stance_by_torque.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Whose account of the trunk's way is taken: motion capture or GPS, the robot's own estimate, or
/// its legs with the accelerometer (VelocitySmoother).
enum class Odometry { kNone, kTruth, kEstimate, kLegs };

/// What somebody who was there says of a moment.
enum class FallVerdict { kFall, kNotAFall, kOperatorStop };
constexpr std::array<std::pair<FallVerdict, std::string_view>, 3> EnumNames(FallVerdict) {
  return {{{FallVerdict::kFall, "fall"},
           {FallVerdict::kNotAFall, "not a fall"},
           {FallVerdict::kOperatorStop, "operator stop"}}};
}
struct FallLabel {
  double time_s = 0.0;  // of the rows
  FallVerdict verdict = FallVerdict::kFall;
};

/// The time of which powers were known.
struct EnergyCover {
  double all_s = 0.0, joints_s = 0.0, battery_s = 0.0;
};

/// What is known of a log before its rows are completed.
struct FieldSetup {
  const core::RobotDescription* robot = nullptr;  // borrowed; null: not known
  std::optional<double> mass_kg = std::nullopt;   // of the whole robot, payload included
  double gravity_mps2 = 9.81;
  Odometry odometry = Odometry::kNone;
  JointSpeed joint_speed = JointSpeed::kMeasured;
  bool has_contacts = false;
  bool has_plan = false;  // without its plan the walking controller is not in charge
  double gap_s = 0.1;     // rows further apart are not one walk
  FallParams falls = {};
  std::vector<FallLabel> labels = {};  // by time
};

/// Completes the rows of a robot's log by what its own sensors tell, so that the same metrics are
/// computed from it as from a simulated walk: when it walked (episode), motion of its trunk
/// (truth), contacts (by the torques of the legs, where the log has none; true_contacts, with the
/// feet's places by kinematics), mass (true_mass), and energy (energy; electrical by the robot's
/// motor parameters, battery by voltage and current). What a log has of these is left as it is. A
/// row is handed on when the next one has come; where the legs tell the motion, when its block of
/// VelocitySmoother has.
class FieldRows {
 public:
  /// @param stand_ins  the groups that were not in the log.
  using OnRow = std::function<void(const logs::Row& row, const logs::RowGroups& stand_ins)>;

  FieldRows(FieldSetup setup, OnRow on_row);
  void Add(const logs::Row& row);
  void Finish();

  /// Falls so far, labels applied.
  [[nodiscard]] const std::vector<FallEvent>& falls() const noexcept { return falls_; }

  /// Of the energies, which are sums over the time that is covered.
  [[nodiscard]] const EnergyCover& cover() const noexcept { return cover_; }

  /// Falls within so much of the one before are the same: nobody sets a robot on its feet so fast.
  static constexpr double kOneFall_s = 1.0;

  /// A label holds for what happens within so much of its time.
  static constexpr double kLabel_s = 2.0;

 private:
  struct Placed {
    std::optional<double> time_s;
    std::optional<Vec3> p_WB, v_WB;
    std::optional<logs::Array12> q_rad;
  };
  /// A row whose motion is not known yet.
  struct Held {
    logs::Row row;
    logs::RowGroups had;
    std::optional<logs::Array12> qd_radps;
    double dt_s = 0.0;    // since the row before; 0 if the robot was placed
    bool begins = false;  // it was placed
  };
  void Complete(logs::Row row, const logs::Row* after);
  [[nodiscard]] bool IsNewPlace(const logs::Row& row) const;
  [[nodiscard]] bool FindFall(const logs::Row& row, double dt_s);
  [[nodiscard]] bool LiesDown(const logs::Row& row, FallCause cause) const;
  void CountOnce(const logs::Row& row, FallCause cause);
  void ApplyLabels(const logs::Row& row);
  [[nodiscard]] std::optional<FallVerdict> LabelNear(double time_s) const;
  void Count(const logs::Row& row, std::string cause);
  [[nodiscard]] std::optional<logs::Array12> SpeedsAt(const logs::Row& row,
                                                      const logs::Row* after) const;
  void HandOnSmoothed();
  void HandOn(Held held, const std::optional<Vec3>& v_WS);
  void FillMotion(Held& held, const std::optional<Vec3>& v_WS);
  [[nodiscard]] std::optional<logs::TruthRow> MotionByLegs(const Held& held, const Vec3& v_WS);
  void FillContacts(logs::Row& row);
  void FillTrueContacts(logs::Row& row, const std::optional<logs::Array12>& qd_radps) const;
  [[nodiscard]] double LeastForce(const std::optional<double>& speed_mps) const;
  [[nodiscard]] bool IsUpright(const logs::Row& row) const;
  void FillMass(logs::Row& row);
  void FillEnergy(logs::Row& row, const std::optional<logs::Array12>& qd_radps, double dt_s);
  void AddJointEnergy(const logs::Array12& tau_Nm, const logs::Array12& qd_radps, double dt_s);

  FieldSetup setup_;
  OnRow on_row_;
  std::optional<core::WholeBodyModel> model_;
  core::WholeBody body_;
  FallClues clues_;
  FallDetector detector_;
  Posture posture_;
  logs::StanceByTorque stance_;
  std::optional<logs::Row> waiting_;
  Placed last_;                                             // of the row before the one that waits
  std::optional<std::pair<double, logs::Array12>> before_;  // angles of that row
  std::uint32_t segment_ = 0;
  std::int64_t rows_ = 0;
  bool fallen_ = false, stopped_ = false;
  std::size_t next_label_ = 0;
  std::vector<FallEvent> falls_;
  std::optional<Mat3> last_R_WB_;
  VelocitySmoother smoother_;
  std::deque<Held> held_;  // for velocities that it has not told
  Vec3 p_legs_W_ = Vec3::Zero();
  logs::EnergyRow energy_;
  EnergyCover cover_;
};

}  // namespace scoria::analysis
