// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/walk_parts.h"

#include <cmath>

#include "analysis/signals/steady.h"

namespace scoria::app {
namespace {

constexpr double kStep_mps = 0.1;

}  // namespace

WalkParts::WalkParts(Series sequencer, double gravity_mps2)
    : sequencer_(std::move(sequencer)), gravity_mps2_(gravity_mps2) {}

WalkParts::Key WalkParts::KeyOf(const logs::Row& row) {
  while (next_change_ < sequencer_.size() && sequencer_[next_change_].time_s <= row.time_s)
    ++next_change_;
  std::string name = "unknown";
  if (!sequencer_.empty())
    name = SequencerName(sequencer_[next_change_ > 0 ? next_change_ - 1 : 0].value);
  const double speed_mps = row.command ? analysis::SpeedOf(*row.command) : 0.0;
  return {name, static_cast<int>(std::lround(speed_mps / kStep_mps))};
}

void WalkParts::AddRow(const logs::Row& row, const logs::RowGroups& stand_ins,
                       const std::vector<analysis::FallEvent>& falls) {
  const bool walking = row.episode && row.episode->operating && !row.episode->fallen;
  const Key key = walking || !current_ ? KeyOf(row) : *current_;  // a fallen robot is not commanded
  if (current_ && key != *current_) {
    logs::Row away = row;
    away.episode->operating = false;
    parts_.at(*current_).AddRow(away, stand_ins);
  }
  current_ = key;
  analysis::MetricsAccumulator& part = parts_.try_emplace(key, gravity_mps2_).first->second;
  part.AddRow(row, stand_ins);
  for (; falls_seen_ < falls.size() && falls[falls_seen_].time_s <= row.time_s; ++falls_seen_) {
    part.AddFall(falls[falls_seen_]);
    ++falls_[key];
  }
}

std::vector<WalkParts::Part> WalkParts::Finish() {
  std::vector<Part> parts;
  for (auto& [key, accumulator] : parts_) {
    Part part{key.first, kStep_mps * key.second, accumulator.Finish()};
    part.metrics.outcome = {falls_[key], std::nullopt, std::nullopt};
    part.metrics.duration_s = part.metrics.walking_s;
    if (part.metrics.walking_s > 0.0) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace scoria::app
