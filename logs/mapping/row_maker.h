// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "logs/format/log_source.h"
#include "logs/mapping/mapping_file.h"
#include "logs/mapping/stream_joiner.h"
#include "logs/row.h"

namespace scoria::logs {

/// Makes rows of joined signals: turns vectors into the frames that rows have, derives velocities
/// that the log has not, adds gravity where an accelerometer leaves it out.
class RowMaker {
 public:
  /// @param file      is borrowed.
  /// @param metadata  of the log.
  RowMaker(const MappingFile& file, const std::map<std::string, LogMetadata>& metadata);

  /// A group is there if everything is that it cannot be without.
  [[nodiscard]] Row Make(double time_s, const StreamJoiner::Instant& instant,
                         const SignalSet& signals) const;

 private:
  [[nodiscard]] std::optional<TruthRow> MakeTruth(const StreamJoiner::Instant& instant,
                                                  const SignalSet& s) const;
  [[nodiscard]] std::optional<EstimateRow> MakeEstimate(const StreamJoiner::Instant& instant,
                                                        const SignalSet& s) const;
  [[nodiscard]] std::optional<MeasuredRow> MakeMeasured(const SignalSet& s) const;
  [[nodiscard]] std::optional<Array12> ForcesInWorld(const std::optional<SignalValues>& forces,
                                                     ForceFrame frame,
                                                     const std::optional<Array3>& rpy_rad) const;

  const MappingFile& file_;
  bool metadata_say_world_ = false;
};

}  // namespace scoria::logs
