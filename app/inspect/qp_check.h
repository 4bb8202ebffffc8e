// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scoria::app {

/// How well the stored solutions of a set meet the Karush-Kuhn-Tucker conditions of their problems:
/// the worst over its records. Forces in N; stationarity, in cost per N
/// for the MPC, relative to max(1, largest term).
struct QpCheck {
  std::string file;
  bool exact = false;  // solved by an active set, not by an interior point
  int records = 0;
  double primal = 0.0;           // dynamics or equalities, and limits
  double dual = 0.0;             // multipliers of the wrong sign
  double stationarity = 0.0;     // gradient of the Lagrangian
  double complementarity = 0.0;  // MPC: Σ slack x multiplier over the tracking cost; WBC: largest
                                 // slack x multiplier over max(1, |z|)

  /// MPC solves stop at a duality gap, WBC solves are exact up to rounding.
  [[nodiscard]] bool Holds() const {
    return primal <= 1e-6 && dual <= 1e-9 && stationarity <= (exact ? 1e-9 : 1e-2) &&
           complementarity <= (exact ? 1e-9 : 1e-3);
  }
};

/// Checks every .bin set of a folder, record by record.
/// Errors: std::runtime_error that names the file and what is wrong.
[[nodiscard]] std::vector<QpCheck> CheckQpSets(const std::filesystem::path& folder);

}  // namespace scoria::app
