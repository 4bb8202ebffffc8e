// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/metric_text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "analysis/metrics/episode_metrics.h"

namespace scoria::analysis {
namespace {

/// "height RMSE 3.1 mm"
std::string ItemText(const MetricInfo& info, double value) {
  return fmt::format("{} {}{}{}", info.title, ShownNumber(info, value),
                     ShownUnit(info).empty() ? "" : " ", ShownUnit(info));
}

/// A name before the first line, and items that are wrapped.
std::string ParagraphOf(std::string_view name, const std::vector<std::string>& items) {
  constexpr std::size_t kWidth = 100, kIndent = 14;
  std::string text, line = fmt::format("  {:<{}}", name, kIndent - 2);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? ", " : "");
    if (i > 0 && line.size() + item.size() > kWidth) {
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
      line = std::string(kIndent, ' ');
    }
    line += item;
  }
  return text + line + "\n";
}

std::string GroupNames(const logs::RowGroups& groups) {
  std::string names;
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (groups[static_cast<std::size_t>(group)])
      names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  return names;
}

std::string PoolingText(const MetricInfo& info) {
  switch (info.pooling) {
    case Pooling::kSum:
      return "sum";
    case Pooling::kMean:
      return fmt::format("mean over {}", info.pooled_over);
    case Pooling::kRms:
      return fmt::format("RMS over {}", info.pooled_over);
    case Pooling::kLargest:
      return "largest";
    case Pooling::kAccumulated:
      break;
  }
  return std::string(info.pooled_over);
}

std::string_view NameOf(Better better) {
  for (const auto& [value, name] : EnumNames(Better{})) {
    if (value == better) return name;
  }
  return "";
}

/// A bar within a cell would end it.
std::string Cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

}  // namespace

std::string_view ShownUnit(const MetricInfo& info) noexcept {
  return info.shown_unit.empty() ? info.unit : info.shown_unit;
}

std::string TitleWithUnit(const MetricInfo& info) {
  return ShownUnit(info).empty() ? std::string(info.title)
                                 : fmt::format("{} [{}]", info.title, ShownUnit(info));
}

std::string ShownNumber(const MetricInfo& info, double value) {
  return fmt::format("{:.{}f}", info.scale * value, info.digits);
}

std::vector<std::string> DescribeNotValid(const Metrics& metrics,
                                          const std::optional<logs::RowGroups>& had,
                                          const Substitutes& substitutes) {
  std::vector<std::pair<logs::RowGroups, std::string>> titles;  // by what is missing
  for (const Metric& m : metrics) {
    const logs::RowGroups missing = MissingGroups(m.info, had, substitutes);
    if (missing.none()) continue;
    auto same = std::find_if(titles.begin(), titles.end(),
                             [&](const auto& other) { return other.first == missing; });
    if (same == titles.end()) same = titles.insert(same, {missing, ""});
    same->second += fmt::format("{}{}", same->second.empty() ? "" : ", ", m.info.title);
  }
  std::vector<std::string> lines;
  for (const auto& [missing, names] : titles)
    lines.push_back(fmt::format("{}: not valid here: {}", names, DescribeMissing(missing)));
  return lines;
}

std::string DescribeMetrics(const Metrics& metrics, const EpisodeMetrics& m) {
  std::string text;
  for (const auto& [family, name] : EnumNames(MetricFamily{})) {
    std::vector<std::string> items;
    for (const Metric& metric : MetricsOf(metrics, family)) {
      if (const auto value = ValueOf(metric, m)) items.push_back(ItemText(metric.info, *value));
    }
    if (!items.empty()) text += ParagraphOf(name, items);
  }
  for (const std::string& line : DescribeNotValid(metrics, m.groups, m.substitutes))
    text += "  " + line + "\n";
  for (const auto& [key, reason] : m.withheld) {
    if (const Metric* metric = FindMetric(metrics, key))
      text += fmt::format("  {}: not valid here: {}\n", metric->info.title, reason);
  }
  return text;
}

std::string MetricsMarkdown(const Metrics& metrics) {
  std::string text =
      "| key | symbol | unit | shown as | needs of the rows | better | pooled by | definition |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const auto& [family, name] : EnumNames(MetricFamily{})) {
    for (const Metric& metric : MetricsOf(metrics, family)) {
      const MetricInfo& m = metric.info;
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} |\n", m.key, Cell(m.symbol),
                          m.unit, Cell(TitleWithUnit(m)), GroupNames(m.needs), NameOf(m.better),
                          PoolingText(m), Cell(m.definition));
    }
  }
  return text;
}

}  // namespace scoria::analysis
