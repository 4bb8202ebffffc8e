// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/draft_file.h"
#include "core/robot/state.h"
#include "logs/format/mcap_writer.h"
#include "logs/row.h"

namespace scoria::app {

/// The log of a replay: rows of the log that it ran on under their own topics, those of each
/// variant as "/replay/NAME/estimate".
class ReplayLogFile {
 public:
  explicit ReplayLogFile(std::filesystem::path path);

  void AddRow(const logs::Row& row);
  /// Estimate, contacts and model of a row, as a variant has them.
  void AddVariant(const std::string& name, const logs::Row& row);
  [[nodiscard]] std::filesystem::path Publish();

 private:
  template <class Group>
  void Write(const std::string& topic, double time_s, const std::optional<Group>& group);

  std::filesystem::path path_;
  logs::McapWriter writer_;
  std::map<std::string, std::uint16_t, std::less<>> channels_;
  logs::Bytes buffer_;
};

/// A trajectory, a line per pose: time, place and quaternion (x y z w) of B, as evo reads it.
/// Source: the format of the RGB-D benchmark of TUM.
class TumFile {
 public:
  explicit TumFile(const std::filesystem::path& path);

  /// @param p_WB_m, rpy_rad  of B, in the frame of whoever estimated it.
  void Add(double time_s, const logs::Array3& p_WB_m, const logs::Array3& rpy_rad);
  [[nodiscard]] std::filesystem::path Publish();

 private:
  core::DraftFile file_;
};

}  // namespace scoria::app
