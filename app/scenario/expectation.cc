// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/expectation.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/scenario/observable.h"
#include "core/config/archive.h"

namespace scoria::app {

std::string Bounds::Problem() const {
  const bool is_range = min || max;
  const int ways = (equals ? 1 : 0) + (between ? 1 : 0) + (is_range ? 1 : 0);
  if (ways == 0) return "needs equals, between, min or max";
  if (ways > 1) return "equals, between, and min with max stand in place of each other";
  if (min && max && *min > *max) return fmt::format("min {} is above max {}", *min, *max);
  if (between && between->front() > between->back())
    return fmt::format("between: {} is above {}", between->front(), between->back());
  return "";
}

void CheckExpectedNames(const core::ConfigNode& node) {
  const core::ConfigNode* expect = node.Find("expect");
  if (expect == nullptr || expect->entries.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, observable] : AllObservables()) names.push_back(name);
  for (const core::ConfigNode::Entry& entry : expect->entries) {
    if (std::ranges::find(names, entry.key) == names.end())
      core::config_detail::ThrowUnknownKey(entry, "expect." + entry.key, names);
  }
}

std::string ArmComparison::Problem() const {
  const bool ratio = ratio_below || ratio_above, difference = difference_below || difference_above;
  if (ratio == difference) return "needs bounds either of the ratio or of the difference";
  if (of == to) return fmt::format("compares {} with itself", of);
  return "";
}

std::string ArmBounds::Problem() const {
  return IsEmpty() && !compare.empty() ? "" : Bounds::Problem();
}

std::string DescribeBreach(const Bounds& b, double value) {
  if (b.equals && !(value == *b.equals)) return fmt::format("must be {:g}", *b.equals);
  if (b.between && !(value >= b.between->front() && value <= b.between->back()))
    return fmt::format("must be from {:g} to {:g}", b.between->front(), b.between->back());
  if (b.min && !(value >= *b.min)) return fmt::format("must be at least {:g}", *b.min);
  if (b.max && !(value <= *b.max)) return fmt::format("must be at most {:g}", *b.max);
  return "";
}

}  // namespace scoria::app
