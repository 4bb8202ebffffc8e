// SPDX-License-Identifier: BSD-3-Clause
// How hard joints and feet work, as the robot's own sensors tell.
#include <cmath>
#include <optional>

#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

/// Root mean square of numbers of the rows in which the robot walks.
template <class Numbers>
class RmsOfRows final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    if (!row.episode->operating || row.episode->fallen) return;
    Numbers::ForEach(row, [&](double x) {
      squares_ += x * x;
      ++count_;
    });
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    return MeasuredIf(count_ > 0.0, std::sqrt(squares_ / count_), count_);
  }

 private:
  double squares_ = 0.0, count_ = 0.0;
};

struct Torques {
  static void ForEach(const logs::Row& row, const auto& take) {
    if (!row.measured->tau_Nm) return;
    for (const double tau_Nm : *row.measured->tau_Nm) take(tau_Nm);
  }
};

struct Speeds {
  static void ForEach(const logs::Row& row, const auto& take) {
    if (!row.measured->qd_radps) return;
    for (const double qd_radps : *row.measured->qd_radps) take(qd_radps);
  }
};

/// Of feet in contact.
struct FootForces {
  static void ForEach(const logs::Row& row, const auto& take) {
    if (!row.contacts->f_F_W_N) return;
    const logs::Array12& f = *row.contacts->f_F_W_N;
    for (std::size_t leg = 0; leg < 4; ++leg) {
      if (row.contacts->contact[leg]) take(std::hypot(f[3 * leg], f[3 * leg + 1], f[3 * leg + 2]));
    }
  }
};

MetricInfo EffortInfo(std::string_view key, std::string_view unit, std::string_view title,
                      RowGroup from, std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kEnergy,
          .unit = unit,
          .title = title,
          .needs = Groups({RowGroup::kEpisode, from}),
          .pooling = Pooling::kRms,
          .pooled_over = "rows",
          .definition = definition};
}

}  // namespace

Metrics EffortMetrics() {
  return {{EffortInfo("torque_rms_Nm", "N m", "torque RMS", RowGroup::kMeasured,
                      "Root mean square of the measured torques of all joints while walking."),
           nullptr, MakeRowMetric<RmsOfRows<Torques>>},
          {EffortInfo("joint_speed_rms_radps", "rad/s", "joint speed RMS", RowGroup::kMeasured,
                      "Root mean square of the measured speeds of all joints while walking."),
           nullptr, MakeRowMetric<RmsOfRows<Speeds>>},
          {EffortInfo("foot_force_rms_N", "N", "foot force RMS", RowGroup::kContacts,
                      "Root mean square of the estimated forces on the feet in contact."),
           nullptr, MakeRowMetric<RmsOfRows<FootForces>>}};
}

}  // namespace scoria::analysis
