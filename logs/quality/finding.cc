// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/finding.h"

#include <algorithm>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

template <class Enum>
std::string_view NameOf(Enum value) {
  for (const auto& [named, name] : EnumNames(Enum{})) {
    if (named == value) return name;
  }
  return "";
}

std::string DescribeSpans(const Finding& f) {
  if (f.spans.empty()) return "";
  std::string text = ", at";
  constexpr std::size_t kShown = 3;
  for (std::size_t i = 0; i < std::min(kShown, f.spans.size()); ++i)
    text += fmt::format(" {:.3f} to {:.3f} s", f.spans[i].begin_s, f.spans[i].end_s);
  if (f.spans.size() > kShown) text += fmt::format(" and {} more", f.count - kShown);
  return text;
}

}  // namespace

RowGroup GroupOf(SignalId signal) noexcept {
  // In the order of SignalId: up to which signal each group goes.
  constexpr std::array<std::pair<SignalId, RowGroup>, 11> kUpTo = {
      {{SignalId::kBatteryCurrent, RowGroup::kMeasured},
       {SignalId::kJointCommandKd, RowGroup::kJointCommand},
       {SignalId::kEstimateAttitude, RowGroup::kEstimate},
       {SignalId::kTruthAttitude, RowGroup::kTruth},
       {SignalId::kTrueFootPosition, RowGroup::kTrueContacts},
       {SignalId::kCommandWz, RowGroup::kCommand},
       {SignalId::kPlanFootTarget, RowGroup::kPlan},
       {SignalId::kReferenceAttitude, RowGroup::kReference},
       {SignalId::kContactForce, RowGroup::kContacts},
       {SignalId::kModelCom, RowGroup::kModel},
       {SignalId::kWbcTime, RowGroup::kSolveTimes}}};
  const auto* found = std::find_if(kUpTo.begin(), kUpTo.end(),
                                   [&](const auto& group) { return signal <= group.first; });
  return found->second;
}

Finding MakeFinding(Severity severity, FindingKind kind, SignalId signal) {
  Finding finding;
  finding.severity = severity;
  finding.kind = kind;
  finding.signal = TraitsOf(signal).key;
  finding.spoils.set(static_cast<std::size_t>(GroupOf(signal)));
  return finding;
}

std::string DescribeFinding(const Finding& f) {
  constexpr std::array<std::string_view, kJointsPerLeg> kJointNames = {"HAA", "HFE", "KFE"};
  std::string where = f.signal.empty() ? "" : " of " + f.signal;
  if (f.leg) where += fmt::format(" {}", LegName(*f.leg));
  if (f.joint) where += fmt::format(" {}", kJointNames[static_cast<std::size_t>(*f.joint)]);
  return fmt::format("{}: {}{}{}: {}{}{}", NameOf(f.severity), NameOf(f.kind), where,
                     DescribeSpans(f), f.evidence, f.repair.empty() ? "" : "; ", f.repair);
}

bool HasError(const std::vector<Finding>& findings,
              std::initializer_list<FindingKind> kinds) noexcept {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
    return f.severity == Severity::kError &&
           std::find(kinds.begin(), kinds.end(), f.kind) != kinds.end();
  });
}

}  // namespace scoria::logs
