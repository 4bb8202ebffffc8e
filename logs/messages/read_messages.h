// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include <fastcdr/exceptions/Exception.h>
#include <fmt/format.h>

#include "logs/format/cdr.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// A message whose bytes are not what its type says.
class DecodeError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Errors: DecodeError that names topic, time and type.
template <class Message>
[[nodiscard]] Message Decode(const LogMessage& m) {
  try {
    return DecodeCdr<Message>(m.data);
  } catch (const eprosima::fastcdr::exception::Exception& e) {
    throw DecodeError(fmt::format("{} at {:.3f} s: cannot be decoded as {}: {}", m.channel.topic,
                                  1e-9 * static_cast<double>(m.log_time_ns), Message::kTypeName,
                                  e.what()));
  }
}

/// Hands the messages of a log to `consume`, as LogSource::ForEach does, up to the first whose
/// DecodeError `consume` lets through. @returns what is wrong with the log, that error included.
/// Errors: what else `consume` throws.
template <class Consume>
[[nodiscard]] std::vector<LogProblem> ReadMessages(LogSource& log, const LogFilter& filter,
                                                   Consume&& consume) {
  std::vector<LogProblem> undecodable;
  try {
    log.ForEach(filter, std::forward<Consume>(consume));
  } catch (const DecodeError& e) {
    undecodable.push_back({LogProblem::Kind::kLost, log.contents().path, e.what()});
  }
  std::vector<LogProblem> problems = log.problems();
  problems.insert(problems.end(), undecodable.begin(), undecodable.end());
  return problems;
}

}  // namespace scoria::logs
