// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace scoria::test {

/// A fresh folder with mpc.bin (forward Euler and other dynamics in turns, pairs of ticks) and
/// wbc.bin, of `records` solved random problems each; removed by the destructor.
class QpFolder {
 public:
  explicit QpFolder(int records);
  ~QpFolder();
  QpFolder(const QpFolder&) = delete;
  QpFolder& operator=(const QpFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace scoria::test
