// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/qp/problems/kkt.h"

namespace scoria::controller {

/// How well the stored solutions of a file meet the optimality conditions of their problems: the
/// worst over its records.
struct QpCheck : KktResidual {
  std::string file;
  bool exact = false;  // solved by an active set, not by an interior point
  int records = 0;

  [[nodiscard]] bool Holds() const noexcept {
    return (exact ? kActiveSetLimits : kInteriorPointLimits).Hold(*this);
  }
};

/// Checks every .bin file of a folder, record by record.
/// Errors: std::runtime_error that names the file and what is wrong.
[[nodiscard]] std::vector<QpCheck> CheckQpFiles(const std::filesystem::path& folder);

}  // namespace scoria::controller
