// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "app/episode/step_record.h"
#include "logs/row.h"

namespace scoria::app {

/// Something that happened in an episode: a fall, a push, a change of the controller.
struct EpisodeEvent {
  std::int64_t step = 0;
  double time_s = 0.0;
  std::string kind, detail;
};

/// Sees an episode step by step and changes nothing in it: the same scenario gives the same bits,
/// whoever looks on.
class EpisodeObserver {
 public:
  virtual ~EpisodeObserver() = default;
  /// The robot was placed and a fresh controller started; also the placement in force when the
  /// observer is attached.
  virtual void OnStart(double /*time_s*/, const controller::Start& /*start*/) {}
  /// At the rate of the body controller, before OnStep, for observers that want rows.
  virtual void OnRow(const StepRecord& /*record*/, const logs::Row& /*row*/) {}
  /// Every physics step, between the controller's answer and the physics.
  virtual void OnStep(const StepRecord& /*record*/) {}
  virtual void OnEvent(const EpisodeEvent& /*event*/) {}
  [[nodiscard]] virtual bool wants_rows() const { return false; }
};

}  // namespace scoria::app
