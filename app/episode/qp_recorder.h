// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "app/episode/observer.h"
#include "controller/controller.h"
#include "controller/qp/sets/qp_file.h"

namespace scoria::app {

/// Writes every MPC and whole-body problem that a controller solves, with its solution and
/// multipliers, to mpc.bin and wbc.bin of a folder. About 17 MB per simulated second.
class QpRecorder final : public EpisodeObserver {
 public:
  /// Errors, here and below: core::FileError; std::runtime_error if the controller's kind keeps no
  /// problem that could be saved.
  QpRecorder(const std::filesystem::path& folder, const controller::ControllerParams& params);

  void OnStep(const StepRecord& record) override;
  void Close();

 private:
  controller::QpFileWriter mpc_, wbc_;
};

}  // namespace scoria::app
