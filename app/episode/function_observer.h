// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "app/episode/observer.h"

namespace scoria::app {

/// An observer made of functions; an empty one is not called.
class FunctionObserver final : public EpisodeObserver {
 public:
  std::function<void(const StepRecord&, const logs::Row&)> on_row;
  std::function<void(const StepRecord&)> on_step;
  std::function<void(const EpisodeEvent&)> on_event;

  void OnRow(const StepRecord& record, const logs::Row& row) override { on_row(record, row); }
  void OnStep(const StepRecord& record) override {
    if (on_step) on_step(record);
  }
  void OnEvent(const EpisodeEvent& event) override {
    if (on_event) on_event(event);
  }
  [[nodiscard]] bool wants_rows() const override { return on_row != nullptr; }
};

}  // namespace scoria::app
