// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/check_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/version.h"
#include "core/text.h"

namespace scoria::app {
namespace {

using nlohmann::json;

/// Text for XML: markup escaped, and nothing that XML 1.0 forbids.
std::string Xml(const std::string& text) {
  std::string escaped;
  for (const char c : core::PrintableText(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string JoinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += Xml(line) + "\n";
  return text;
}

std::string TestCase(const CheckOutcome& o) {
  std::string text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n",
                  Xml(o.test->file.parent_path().string()), Xml(o.test->name), o.wall_s);
  const std::vector<std::string> problems = ProblemsOf(o);
  if (!problems.empty()) {
    const bool error = o.status == CheckStatus::kError;
    const std::string_view tag = error ? "error" : "failure";
    text +=
        fmt::format("      <{} message=\"{}\" type=\"{}\">{}</{}>\n", tag, Xml(problems.front()),
                    error ? "episode" : "bound", JoinLines(problems), tag);
  }
  std::vector<std::string> files;
  for (const auto& file : o.artifacts) files.push_back(file.string());
  if (!o.artifact_problem.empty()) files.push_back(o.artifact_problem);
  if (!files.empty()) text += fmt::format("      <system-out>{}</system-out>\n", JoinLines(files));
  return text + "    </testcase>\n";
}

json ToJson(const Finding& f) {
  return {{"name", f.name},
          {"value", f.value ? json(*f.value) : json(nullptr)},
          {"problem", f.problem}};
}

json ToJson(const CheckOutcome& o) {
  json j = {{"name", o.test->name},
            {"file", o.test->file.string()},
            {"status", core::EnumName(o.status)},
            {"episodes", o.test->jobs.size()},
            {"wall_s", o.wall_s},
            {"errors", o.errors},
            {"bounds", json::array()},
            {"left_out_overrides", o.test->unfit},
            {"artifacts", json::array()},
            {"artifact_problem", o.artifact_problem}};
  for (const Finding& f : o.findings) j["bounds"].push_back(ToJson(f));
  for (const auto& file : o.artifacts) j["artifacts"].push_back(file.string());
  return j;
}

}  // namespace

std::vector<std::string> ProblemsOf(const CheckOutcome& outcome) {
  std::vector<std::string> problems = outcome.errors;
  for (const Finding& f : outcome.findings) {
    if (!f.problem.empty()) problems.push_back(fmt::format("{} {}", f.name, f.problem));
  }
  return problems;
}

std::string ToJunit(std::span<const CheckOutcome> outcomes) {
  const auto count = [&](CheckStatus status) {
    return std::ranges::count(outcomes, status, &CheckOutcome::status);
  };
  double wall_s = 0.0;
  std::string cases;
  for (const CheckOutcome& o : outcomes) {
    wall_s += o.wall_s;
    cases += TestCase(o);
  }
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", outcomes.size(),
                  count(CheckStatus::kFailed), count(CheckStatus::kError), wall_s);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"scoria check\" {}>\n"
      "  <testsuite name=\"scoria {}\" {}>\n{}  </testsuite>\n</testsuites>\n",
      counts, Xml(kVersion), counts, cases);
}

std::string ToJsonText(std::span<const CheckOutcome> outcomes) {
  json tests = json::array();
  for (const CheckOutcome& o : outcomes) tests.push_back(ToJson(o));
  return analysis::JsonText({{"version", kVersion}, {"tests", std::move(tests)}});
}

}  // namespace scoria::app
