// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/log_source.h"

#include <algorithm>

#include <fmt/format.h>

namespace scoria::logs {

bool LogFilter::HasTopic(const std::string& topic) const {
  return !topics || std::find(topics->begin(), topics->end(), topic) != topics->end();
}

bool LosesData(const std::vector<LogProblem>& problems) {
  return std::any_of(problems.begin(), problems.end(),
                     [](const LogProblem& p) { return p.kind != LogProblem::Kind::kOdd; });
}

std::string ProblemText(const std::vector<LogProblem>& problems) {
  std::string text;
  for (const LogProblem& p : problems)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", p.file.string(), p.what);
  return text;
}

}  // namespace scoria::logs
