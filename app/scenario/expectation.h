// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/field.h"
#include "core/config/node.h"

namespace scoria::app {

/// Where a number has to lie. `falls: 0` is equals, `falls: [0, 2]` is between.
struct Bounds {
  static constexpr const char* kScalarKey = "equals";
  static constexpr const char* kListKey = "between";
  std::optional<double> equals, min, max;
  std::optional<std::array<double, 2>> between;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("equals", equals, {.doc = "also written short, as falls: 0"});
    a.Field("min", min);
    a.Field("max", max);
    a.Field("between", between, {.doc = "both included; also written short, as falls: [0, 2]"});
  }
  [[nodiscard]] bool IsEmpty() const noexcept { return !equals && !min && !max && !between; }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const Bounds&) const = default;
};

/// @returns how `value` breaks the bounds, as "must be at most 12"; empty if it does not.
[[nodiscard]] std::string DescribeBreach(const Bounds& bounds, double value);

/// Errors: core::ConfigError if the `expect` of a scenario or campaign bounds what there is not.
void CheckExpectedNames(const core::ConfigNode& node);

/// What an episode must show, by name of an Observable.
using Expectations = std::map<std::string, Bounds>;

/// An arm of a campaign against another, on the same seeds. A bound is kept where the data show it:
/// where the one-sided confidence interval lies within it.
struct ArmComparison {
  std::string of, to;
  std::optional<double> ratio_below, ratio_above, difference_below, difference_above;
  double confidence = 0.95;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("of", of, {.doc = "arm"});
    a.Required("to", to, {.doc = "arm that it is compared with"});
    a.Field("ratio_below", ratio_below, {.min = 0.0, .doc = "of falls per metre"});
    a.Field("ratio_above", ratio_above, {.min = 0.0});
    a.Field("difference_below", difference_below, {.doc = "of a metric's mean over seeds"});
    a.Field("difference_above", difference_above);
    a.Field("confidence", confidence, {.min = 0.5, .max = 0.999999, .doc = "one-sided"});
  }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const ArmComparison&) const = default;
};

/// Bounds of the value of an arm, pooled over its episodes, and of arms against each other.
struct ArmBounds : Bounds {
  std::vector<std::string> arms;
  std::vector<ArmComparison> compare;
  template <class Archive>
  void Serialize(Archive& a) {
    Bounds::Serialize(a);
    a.Field("arms", arms, {.doc = "that the bounds are for; empty: each"});
    a.Field("compare", compare);
  }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const ArmBounds&) const = default;
};

/// What the episodes of a campaign must show together, by name of an Observable.
using ArmExpectations = std::map<std::string, ArmBounds>;

}  // namespace scoria::app
