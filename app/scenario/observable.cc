// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/observable.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "analysis/metrics/registry.h"
#include "app/episode/event_kinds.h"
#include "controller/safety/supervisor.h"
#include "core/robot/counters.h"

namespace scoria::app {
namespace {

using analysis::MetricInfo;

/// The metric's key in the unit that is shown; empty where that is the unit of the key.
std::string ShownKey(const MetricInfo& info) {
  const std::string_view shown = KeyOfUnit(info.shown_unit), unit = KeyOfUnit(info.unit);
  if (shown.empty()) return "";
  std::string key(info.key);
  const std::string ending = unit.empty() ? "" : fmt::format("_{}", unit);
  if (!key.ends_with(ending)) return "";
  key.resize(key.size() - ending.size());
  return fmt::format("{}_{}", key, shown);
}

void AddMetrics(Observables& all) {
  for (const analysis::Metric& metric : analysis::AllMetrics()) {
    const MetricInfo& info = metric.info;
    const std::string key(info.key), shown = ShownKey(info);
    const std::string_view family = core::EnumName(info.family);
    const auto add = [&](const std::string& name, double scale) {
      all[name] =
          all[fmt::format("{}.{}", family, name)] = {Observable::Source::kMetric, key, scale};
    };
    add(key, 1.0);
    if (!shown.empty()) add(shown, info.scale);
  }
}

}  // namespace

std::string_view KeyOfUnit(std::string_view unit) noexcept {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kKeys = {
      {{"m", "m"},
       {"mm", "mm"},
       {"s", "s"},
       {"ms", "ms"},
       {"µs", "us"},
       {"rad", "rad"},
       {"deg", "deg"},
       {"m/s", "mps"},
       {"mm/s", "mmps"},
       {"%", "pct"}}};
  for (const auto& [name, key] : kKeys) {
    if (name == unit) return key;
  }
  return "";
}

bool IsMetric(std::string_view name) {
  const Observables all = AllObservables();
  const auto found = all.find(name);
  return found != all.end() && found->second.source == Observable::Source::kMetric;
}

bool IsFallRate(std::string_view name) {
  const Observables all = AllObservables();
  const auto found = all.find(name);
  return found != all.end() && (found->second.key == "falls" || found->second.key == "falls_per_m");
}

Observables AllObservables() {
  Observables all;
  AddMetrics(all);
  for (const std::string_view kind : kEventKinds)
    all[fmt::format("events.{}", kind)] = {Observable::Source::kEvent, std::string(kind)};
  for (const auto& [count, name] : EnumNames(Count{}))
    all[fmt::format("counters.{}", name)] = {Observable::Source::kCounter, std::string(name)};
  for (const auto& [monitor, name] : controller::EnumNames(controller::Monitor{}))
    all[fmt::format("supervisor.{}", name)] = {Observable::Source::kCounter,
                                               fmt::format("fallback_{}", name)};
  return all;
}

}  // namespace scoria::app
