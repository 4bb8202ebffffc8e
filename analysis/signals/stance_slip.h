// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/math/types.h"
#include "core/robot/legs.h"
#include "logs/row.h"

namespace scoria::analysis {

/// How far a foot goes on the map from its touchdown to its lift-off. Of stances whose touchdown
/// was seen, while the robot walks.
class StanceSlips {
 public:
  using OnSlip = std::function<void(double slip_m)>;

  /// @param on_slip  is told of the stances that end with this row.
  /// @pre the row has episode and true contacts.
  void AddRow(const logs::Row& row, const OnSlip& on_slip);

 private:
  struct Foot {
    bool seen_up = false, down = false;
    Vec2 touchdown = Vec2::Zero(), now = Vec2::Zero();
  };
  std::array<Foot, kNumLegs> feet_;
  std::uint32_t segment_ = 0;
};

}  // namespace scoria::analysis
