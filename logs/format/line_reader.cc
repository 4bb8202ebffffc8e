// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/line_reader.h"

namespace scoria::logs {

bool LineReader::ReadMore() {
  constexpr std::uint64_t kBlock = 256 << 10;
  const Bytes more = file_.Read(offset_, kBlock);
  if (more.empty()) {
    offset_ = file_.size();
    return false;
  }
  block_.erase(block_.begin(), block_.begin() + static_cast<std::ptrdiff_t>(start_));
  block_.insert(block_.end(), more.begin(), more.end());
  start_ = 0;
  offset_ += more.size();
  return true;
}

std::optional<std::string_view> LineReader::Next() {
  constexpr std::string_view kBom = "\xef\xbb\xbf";
  std::size_t searched = 0;
  const auto rest = [&] {
    return std::string_view(reinterpret_cast<const char*>(block_.data()), block_.size())
        .substr(start_);
  };
  std::size_t end = rest().find('\n');
  while (end == std::string_view::npos) {
    searched = rest().size();
    has_too_long_line_ = searched > kLongest;
    if (has_too_long_line_ || !ReadMore()) break;
    end = rest().find('\n', searched);
  }
  if (has_too_long_line_ || rest().empty()) return std::nullopt;
  std::string_view line = rest().substr(0, end);
  start_ += end == std::string_view::npos ? line.size() : end + 1;
  if (number_++ == 0 && line.starts_with(kBom)) line.remove_prefix(kBom.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace scoria::logs
