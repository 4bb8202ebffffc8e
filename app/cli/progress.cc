// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace scoria::app {

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      enabled_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_(start_ - std::chrono::seconds(1)) {}

ProgressBar::~ProgressBar() { Clear(); }

void ProgressBar::Clear() {
  if (enabled_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::Update(double done, const std::string& counts) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  constexpr int kWidth = 30;
  const double share = std::clamp(done, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string eta =
      share > 0.01 ? fmt::format("{:.0f} s left", elapsed_s * (1.0 - share) / share) : "";
  fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} % {} {}", title_, std::string(filled, '#'),
             std::string(kWidth - filled, '.'), 100.0 * share, eta, counts);
  std::fflush(stderr);
}

}  // namespace scoria::app
