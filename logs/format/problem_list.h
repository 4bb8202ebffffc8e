// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::logs {

/// Collects what is wrong with a log, each thing once.
class ProblemList {
 public:
  void Add(LogProblem problem) {
    if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
      problems_.push_back(std::move(problem));
  }
  [[nodiscard]] const std::vector<LogProblem>& problems() const { return problems_; }

 private:
  std::vector<LogProblem> problems_;
};

}  // namespace scoria::logs
