// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/open_log.h"

#include <stdexcept>

#include <fmt/format.h>

#include "core/file_kind.h"
#include "logs/format/mcap_log.h"
#include "logs/format/random_access_file.h"

namespace scoria::logs {
namespace {

std::string WhatElse(const Bytes& head) {
  if (head.empty()) return "is empty";
  const core::FileKind kind =
      core::KindOfContent({reinterpret_cast<const char*>(head.data()), head.size()});
  return kind.name.empty() ? "is not a log that scoria reads" : core::NotOfKind(kind, "a log");
}

}  // namespace

std::unique_ptr<LogSource> OpenLog(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw std::runtime_error(fmt::format("{}: is a folder, not a log", path.string()));
  constexpr std::uint64_t kHead = 4096, kTail = 16;
  Bytes head, tail;
  {
    const RandomAccessFile file(path);
    head = file.Read(0, kHead);
    tail = file.Read(file.size() - std::min(file.size(), kTail), kTail);
  }
  if (IsMcap(head, tail)) return OpenMcap(path);
  throw std::runtime_error(fmt::format("{}: {}", path.string(), WhatElse(head)));
}

}  // namespace scoria::logs
