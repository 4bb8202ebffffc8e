#include "analysis/metrics/families/families.h"

namespace scoria::analysis {

class PeakCurrent final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    const std::optional<double>& now_A = row.measured->battery_A;
    if (now_A && (!peak_ || *now_A > peak_->value)) peak_ = {*now_A};
  }
  std::optional<Measured> Value() const override { return peak_; }

 private:
  std::optional<Measured> peak_;
};

Metric PeakCurrentMetric() {
  return {.info = {.key = "peak_current_A",
                   .unit = "A",
                   .title = "peak battery current",
                   .needs = Groups({logs::RowGroup::kMeasured}),
                   .better = Better::kLower,
                   .pooling = Pooling::kLargest,
                   .definition = "Largest current that the battery delivered."},
          .make = MakeRowMetric<PeakCurrent>};
}

}  // namespace scoria::analysis
