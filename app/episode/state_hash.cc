// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/state_hash.h"

#include "core/hash.h"

namespace scoria::app {

std::uint64_t ChainHash(const RobotState& s, std::uint64_t before) {
  core::Hash64 hash;
  const double seed[] = {static_cast<double>(before >> 32),
                         static_cast<double>(before & 0xffffffffu)};
  hash.Add(seed, 2);
  hash.Add(s.p_WB.data(), 3);
  hash.Add(s.R_WB.data(), 9);
  hash.Add(s.v_WB.data(), 3);
  hash.Add(s.w_WB.data(), 3);
  hash.Add(Flatten(s.q).data(), kNumJoints);
  hash.Add(Flatten(s.qd).data(), kNumJoints);
  return hash.value();
}

}  // namespace scoria::app
