// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace scoria::app {

/// One line on the terminal: share done, time left, live counts. Silent when standard error is not
/// a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  /// @param done in [0, 1].
  void Update(double done, const std::string& counts);
  /// Makes room for other output; the next Update shows the line again.
  void Clear();

 private:
  std::string title_;
  bool enabled_;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace scoria::app
