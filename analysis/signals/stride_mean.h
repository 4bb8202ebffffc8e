// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/math/types.h"

namespace scoria::analysis {

/// Moving mean over the last stride, which takes the ripple of every step out of a signal.
class StrideMean {
 public:
  /// @param stride_s > 0. @returns the mean of the samples of the last stride, this one included,
  /// once a whole stride has been seen.
  std::optional<Vec2> Add(double time_s, const Vec2& value, double stride_s);
  void Reset() noexcept;

 private:
  struct Sample {
    double time_s;
    Vec2 value;
  };
  std::vector<Sample> samples_;
  std::size_t first_ = 0;  // of the last stride
};

}  // namespace scoria::analysis
