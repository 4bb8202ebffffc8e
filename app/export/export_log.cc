// SPDX-License-Identifier: BSD-3-Clause
#include "app/export/export_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/format/open_log.h"

namespace scoria::app {
namespace {

using TimeLimits = std::numeric_limits<std::int64_t>;

/// `offset_s` after `start_ns`, as far as numbers go.
std::int64_t TimeAfter(std::int64_t start_ns, double offset_s) {
  constexpr double kFarthest_s = 9e9;  // 285 years
  const double bounded_s = std::clamp(offset_s, -kFarthest_s, kFarthest_s);
  std::int64_t time_ns = 0;
  if (!__builtin_add_overflow(start_ns, std::llround(bounded_s * 1e9), &time_ns)) return time_ns;
  return offset_s < 0.0 ? TimeLimits::min() : TimeLimits::max();
}

void CheckTopics(const logs::LogContents& contents, const std::vector<std::string>& wanted) {
  std::vector<std::string> known;
  for (const logs::LogChannel& channel : contents.channels) known.push_back(channel.topic);
  for (const std::string& topic : wanted) {
    if (std::find(known.begin(), known.end(), topic) != known.end()) continue;
    throw std::runtime_error(fmt::format("{}: has no topic \"{}\"{}; scoria info lists them",
                                         contents.path.string(), core::Shown(topic),
                                         core::DidYouMean(topic, known)));
  }
}

}  // namespace

std::vector<std::string> ExportSource::Problems() const {
  std::vector<std::string> lines;
  for (const logs::LogProblem& problem : log->problems())
    lines.push_back(fmt::format("{}: {}", problem.file.string(), problem.what));
  return lines;
}

ExportSource OpenExport(const ExportOptions& options) {
  ExportSource source{logs::OpenLog(options.log), {}};
  const logs::LogContents& contents = source.log->contents();
  if (options.topics) CheckTopics(contents, *options.topics);
  source.filter.topics = options.topics;
  source.filter.order = logs::LogOrder::kStored;
  const std::int64_t start_ns = contents.span ? contents.span->first_ns : 0;
  if (options.from_s) source.filter.from_ns = TimeAfter(start_ns, *options.from_s);
  if (options.to_s) source.filter.to_ns = TimeAfter(start_ns, *options.to_s);
  return source;
}

void CheckTarget(const std::filesystem::path& file, const ExportOptions& options) {
  if (std::filesystem::is_directory(file))
    throw std::runtime_error(fmt::format("{}: is a folder; name a file", file.string()));
  if (std::filesystem::exists(file) && !options.force)
    throw std::runtime_error(fmt::format("{}: exists; --force overwrites it", file.string()));
}

}  // namespace scoria::app
