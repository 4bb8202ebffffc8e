// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "controller/controller.h"

namespace scoria::app {

/// Writes every MPC and whole-body problem that a controller solves, with its solution and
/// multipliers, to mpc.bin and wbc.bin of a folder. About 17 MB per simulated second.
class QpRecorder {
 public:
  /// Errors: std::runtime_error, if a file cannot be written, or the controller's kind keeps no
  /// problem that could be saved.
  QpRecorder(const std::filesystem::path& folder, const controller::ControllerParams& params);
  ~QpRecorder();

  void Record(const controller::Controller& controller, const controller::ControlOutput& out);

 private:
  /// One file of records of equal size; the header is written again at the end.
  class File {
   public:
    File(const std::filesystem::path& path, std::string_view magic, std::array<int, 5> sizes);
    ~File();
    void Write(const std::vector<double>& record);

   private:
    void PutHeader();
    void Check() const;
    std::filesystem::path path_;
    std::ofstream out_;
    std::string_view magic_;
    std::array<int, 5> sizes_;  // d0, d1, d2, record, meta
    int count_ = 0;
  };
  void RecordMpc(const controller::ConvexMpc& mpc);
  void RecordWbc(const controller::TsidRecord& wbc);

  int horizon_;
  File mpc_, wbc_;
};

}  // namespace scoria::app
