// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

class FallbackShare final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    if (!row.episode->operating || row.episode->fallen) return;
    const auto& engaged = row.supervision->fallen_back;
    ++rows_;
    if (std::find(engaged.begin(), engaged.end(), true) != engaged.end()) ++engaged_;
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    if (rows_ == 0.0) return std::nullopt;
    return Measured{engaged_ / rows_, rows_};
  }

 private:
  double rows_ = 0.0, engaged_ = 0.0;
};

}  // namespace

Metric FallbackShareMetric() {
  return {.info = {.key = "fallback_share",
                   .family = MetricFamily::kSafety,
                   .title = "time on a fallback",
                   .shown_unit = "%",
                   .scale = 100.0,
                   .needs = Groups({logs::RowGroup::kEpisode, logs::RowGroup::kSupervision}),
                   .better = Better::kLower,
                   .pooled_over = "rows",
                   .definition = "Share of the walking time in which the supervisor had engaged "
                                 "the fallback of some stage."},
          .make = MakeRowMetric<FallbackShare>};
}

}  // namespace scoria::analysis
