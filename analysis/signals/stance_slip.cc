// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/stance_slip.h"

#include <cmath>

namespace scoria::analysis {

void StanceSlips::AddRow(const logs::Row& row, const OnSlip& on_slip) {
  const logs::EpisodeRow& episode = *row.episode;
  const bool walks = episode.operating && !episode.fallen && row.true_contacts->p_WF_m;
  for (std::size_t leg = 0; leg < feet_.size(); ++leg) {
    Foot& foot = feet_[leg];
    if (!walks || episode.segment != segment_) {
      foot = {};
      continue;
    }
    const double* p = &(*row.true_contacts->p_WF_m)[3 * leg];
    if (!row.true_contacts->contact[leg]) {
      if (foot.down)
        on_slip(std::hypot(foot.now.x() - foot.touchdown.x(), foot.now.y() - foot.touchdown.y()));
      foot = {.seen_up = true};
    } else if (foot.seen_up) {
      if (!foot.down) foot.touchdown = {p[0], p[1]};
      foot.now = {p[0], p[1]};
      foot.down = true;
    }
  }
  segment_ = episode.segment;
}

}  // namespace scoria::analysis
