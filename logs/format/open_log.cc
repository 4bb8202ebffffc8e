// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/open_log.h"

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/file_kind.h"
#include "logs/format/bag_files.h"
#include "logs/format/bag_log.h"
#include "logs/format/csv_log.h"
#include "logs/format/db3_database.h"
#include "logs/format/db3_log.h"
#include "logs/format/mcap_log.h"
#include "logs/format/random_access_file.h"
#include "logs/format/temporary_folder.h"
#include "logs/format/zstd_frames.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// The first and last bytes of a file.
struct Ends {
  Bytes head, tail;
  explicit Ends(const fs::path& path) {
    constexpr std::uint64_t kHead = 4096, kTail = 16;
    const RandomAccessFile file(path);
    head = file.Read(0, kHead);
    tail = file.Read(file.size() - std::min(file.size(), kTail), kTail);
  }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(head.data()), head.size()};
  }
};

/// A file whose content is a log. @returns null if it is none.
std::unique_ptr<LogSource> OpenContent(const LogFile& file, const Ends& ends) {
  if (IsMcap(ends.head, ends.tail)) return OpenMcap(file);
  if (IsSqlite(ends.head)) return OpenDb3(file);
  return nullptr;
}

[[noreturn]] void FailNoLog(const LogFile& file, const Ends& ends) {
  std::string what = "is empty";
  if (!ends.head.empty()) {
    const core::FileKind kind = core::KindOfContent(ends.text());
    what = kind.name.empty() ? "is not a log that scoria reads"
                             : core::NotOfKind(kind, "a log that scoria reads");
  }
  throw std::runtime_error(fmt::format("{}: {}", file.shown.string(), what));
}

std::unique_ptr<LogSource> OpenUnpacked(const fs::path& path) {
  const TemporaryFolder folder;
  const fs::path unpacked = folder.path() / "unpacked";
  std::vector<LogProblem> problems;
  const RandomAccessFile packed(path);
  std::string problem = UnpackZstd(packed, unpacked, LargestUnpackedLog(packed.size()));
  if (!problem.empty()) problems.push_back({LogProblem::Kind::kCut, path, std::move(problem)});
  const LogFile file(path, unpacked, std::move(problems));
  const Ends ends(unpacked);
  if (std::unique_ptr<LogSource> log = OpenContent(file, ends)) return log;
  FailNoLog(file, ends);
}

std::unique_ptr<LogSource> OpenFile(const fs::path& path) {
  const Ends ends(path);
  if (IsZstd(ends.head)) return OpenUnpacked(path);
  if (std::unique_ptr<LogSource> log = OpenContent(LogFile(path), ends)) return log;
  if (IsCsv(path)) return OpenCsv({path});
  FailNoLog(LogFile(path), ends);
}

/// The bag in a folder. @returns null if there is none.
std::unique_ptr<LogSource> OpenBag(const fs::path& path, const fs::path& folder) {
  BagFiles bag = FindBagFiles(folder);
  std::vector<std::unique_ptr<LogSource>> parts;
  for (const fs::path& file : bag.files) {
    try {
      parts.push_back(OpenFile(file));
    } catch (const std::runtime_error& e) {
      if (bag.files.size() == 1) throw;
      const std::string what = e.what(), name = file.string() + ": ";
      bag.problems.push_back({LogProblem::Kind::kLost, file,
                              what.starts_with(name) ? what.substr(name.size()) : what});
    }
  }
  if (!bag.files.empty() && parts.empty())
    throw std::runtime_error(fmt::format("{}: none of its files can be read ({})", path.string(),
                                         ProblemText(bag.problems)));
  return parts.empty() ? nullptr : JoinBag(path, bag, std::move(parts));
}

std::unique_ptr<LogSource> OpenFolder(const fs::path& path) {
  if (const auto tables = CsvFilesIn(path); !tables.empty()) return OpenCsv(tables);
  if (std::unique_ptr<LogSource> bag = OpenBag(path, path)) return bag;
  throw std::runtime_error(
      fmt::format("{}: is a folder without a log (no .db3 or .mcap file, packed by zstd or not); "
                  "it holds {}",
                  path.string(), FolderSummary(path)));
}

/// metadata.yaml stands for the bag that it lies in, also where it is empty.
bool IsBagMetadata(const fs::path& path) {
  return path.filename() == kBagMetadata ||
         Ends(path).text().starts_with("rosbag2_bagfile_information");
}

}  // namespace

std::unique_ptr<LogSource> OpenLog(const fs::path& path) {
  if (fs::is_directory(path)) return OpenFolder(path);
  if (fs::exists(path) && IsBagMetadata(path)) return OpenFolder(fs::absolute(path).parent_path());
  return OpenFile(path);
}

std::unique_ptr<LogSource> OpenLog(const std::vector<fs::path>& paths) {
  if (paths.size() == 1) return OpenLog(paths.front());
  for (const fs::path& path : paths) {
    if (fs::is_directory(path) || !IsCsv(path))
      throw std::runtime_error(
          fmt::format("{}: is no CSV file; only those can be one log together", path.string()));
  }
  return OpenCsv(paths);
}

}  // namespace scoria::logs
