// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/qp_recorder.h"

#include <stdexcept>

#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// The folder, once nothing is wrong with the controller.
const fs::path& Prepare(const fs::path& folder, const controller::ControllerParams& params) {
  if (params.mpc.threaded)
    throw std::runtime_error("--save-qps: controller.mpc.threaded must be false");
  if (!std::holds_alternative<controller::TsidParams>(params.wbc))
    throw std::runtime_error("--save-qps: controller.wbc.type must be tsid");
  core::CreateFolders(folder);
  return folder;
}

}  // namespace

QpRecorder::QpRecorder(const fs::path& folder, const controller::ControllerParams& params)
    : mpc_(Prepare(folder, params) / "mpc.bin", controller::QpFileShape::Ocp(params.mpc.horizon)),
      wbc_(folder / "wbc.bin", controller::QpFileShape::Tsid(controller::TsidVariables::kReduced)) {
}

void QpRecorder::OnStep(const StepRecord& record) {
  const controller::ConvexMpc& mpc = record.controller.mpc();
  if (record.control.mpc_updated && IsUsable(mpc.solution().status))
    mpc_.Write(controller::MakeRecord(mpc.qp(), mpc.solution()));
  const controller::TsidRecord* wbc = record.controller.wbc().last();
  if (record.control.wbc_updated && wbc != nullptr &&
      wbc->solution.status == controller::SolveStatus::kOptimal)
    wbc_.Write(controller::MakeRecord(*wbc));
}

void QpRecorder::Close() {
  mpc_.Close();
  wbc_.Close();
}

}  // namespace scoria::app
