// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/db3_database.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/files.h"
#include "logs/format/random_access_file.h"
#include "logs/format/temporary_folder.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSqliteMagic("SQLite format 3\0", 16);
constexpr std::uint64_t kSqliteHeader = 100;
constexpr std::size_t kPageSizeAt = 16, kChangesAt = 24, kPagesAt = 28, kPagesValidForAt = 92;

std::uint32_t BigEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte b : bytes) value = value << 8 | static_cast<std::uint32_t>(b);
  return value;
}

/// The pages that a database announces and those that it has.
struct PageCounts {
  std::uint64_t page_size = 0, announced = 0, present = 0;
};

/// Nothing where the header does not tell.
std::optional<PageCounts> CountPages(const fs::path& path) {
  const RandomAccessFile file(path);
  const Bytes header = file.Read(0, kSqliteHeader);
  if (header.size() < kSqliteHeader) return std::nullopt;
  const auto number = [&](std::size_t at, std::size_t size) {
    return BigEndian(std::span(header).subspan(at, size));
  };
  PageCounts counts;
  counts.page_size = number(kPageSizeAt, 2);
  if (counts.page_size == 1) counts.page_size = 1 << 16;  // two bytes cannot say it
  if (counts.page_size == 0 || number(kChangesAt, 4) != number(kPagesValidForAt, 4))
    return std::nullopt;
  counts.announced = number(kPagesAt, 4);
  counts.present = file.size() / counts.page_size;
  return counts;
}

/// Makes the page count of a copy what it has.
void MendPageCount(const fs::path& copy, const PageCounts& counts) {
  fs::resize_file(copy, counts.present * counts.page_size);
  std::fstream file(copy, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(kPagesAt);
  for (int shift = 24; shift >= 0; shift -= 8)
    file.put(static_cast<char>(counts.present >> shift & 0xFF));
  file.close();
  if (!file) throw core::FileError(copy, "cannot write", errno);
}

fs::path Beside(const fs::path& path, const char* suffix) { return path.string() + suffix; }

std::uint64_t SizeOf(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

void CopyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (!error) fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write, error);
  if (error)
    throw core::FileError(from, fmt::format("cannot be copied to {}", to.string()), error.value());
}

/// A database in a folder of its own.
class Copy {
 public:
  explicit Copy(const fs::path& from) : path_(folder_.path() / "bag.db3") { CopyFile(from, path_); }

  /// With -wal and -journal. A database that a recorder writes to meanwhile is copied again, since
  /// its parts have to be of one moment. @returns whether they are.
  bool AddLogs(const fs::path& from) {
    constexpr int kTries = 3;
    for (int i = 0; i < kTries; ++i) {
      const auto before = fs::last_write_time(from);
      if (i > 0) CopyFile(from, path_);
      for (const char* suffix : {"-wal", "-journal"}) {
        if (SizeOf(Beside(from, suffix)) > 0) CopyFile(Beside(from, suffix), Beside(path_, suffix));
      }
      if (fs::last_write_time(from) == before) return true;
    }
    return false;
  }

  /// Lets SQLite apply -wal and -journal.
  void Recover() const {
    const SqliteDatabase database(path_, SqliteDatabase::Mode::kRecover);
    database.Run("SELECT count(*) FROM sqlite_master");  // a hot journal is rolled back on reading
    database.Run("PRAGMA wal_checkpoint(TRUNCATE)");
  }

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  fs::path path_;
};

/// Whether a -journal is of a transaction that did not end. Source: [SqliteFormat] section 3.
bool IsHot(const fs::path& journal) {
  constexpr std::uint32_t kJournalMagic = 0xd9d505f9;
  return SizeOf(journal) > 0 &&
         BigEndian(RandomAccessFile(journal).Read(0, sizeof kJournalMagic)) == kJournalMagic;
}

/// Opens what a recorder left unfinished.
class Opener {
 public:
  explicit Opener(const LogFile& file) : file_(file), problems_(file.problems) {}

  Db3Database Open() {
    const bool has_wal = SizeOf(Beside(file_.path, "-wal")) > 0;
    const bool is_hot = IsHot(Beside(file_.path, "-journal"));
    if (has_wal || is_hot) Recover(has_wal);
    const std::optional<PageCounts> pages = CountPages(path());
    const bool is_cut = pages && pages->present < pages->announced;
    if (is_cut) {
      if (!copy_) copy_.emplace(file_.path);
      MendPageCount(copy_->path(), *pages);
      Report(LogProblem::Kind::kCut, fmt::format("cut off: {} of its {} pages are there",
                                                 pages->present, pages->announced));
    }
    return {SqliteDatabase(path(), SqliteDatabase::Mode::kUnchanging), is_cut,
            std::move(problems_)};
  }

 private:
  [[nodiscard]] const fs::path& path() const { return copy_ ? copy_->path() : file_.path; }

  void Recover(bool has_wal) {
    const std::string name = Beside(file_.shown, has_wal ? "-wal" : "-journal").filename();
    copy_.emplace(file_.path);
    if (!copy_->AddLogs(file_.path))
      Report(LogProblem::Kind::kLost, "is being written to; its newest messages may be missing");
    try {
      copy_->Recover();
      Report(LogProblem::Kind::kOdd,
             has_wal ? fmt::format("was not closed; what {} holds was read with it", name)
                     : fmt::format("was not closed; the transaction that {} tells of did not end "
                                   "and was undone, in a copy",
                                   name));
    } catch (const SqliteError& e) {
      Report(LogProblem::Kind::kLost, fmt::format("{} cannot be applied ({})", name, e.what()));
    }
  }

  void Report(LogProblem::Kind kind, std::string what) {
    problems_.push_back({kind, file_.shown, std::move(what)});
  }

  const LogFile& file_;
  std::vector<LogProblem> problems_;
  std::optional<Copy> copy_;
};

}  // namespace

bool IsSqlite(std::span<const std::byte> head) {
  return head.size() >= kSqliteMagic.size() &&
         std::ranges::equal(head.first(kSqliteMagic.size()),
                            std::as_bytes(std::span(kSqliteMagic)));
}

Db3Database OpenDb3Database(const LogFile& file) { return Opener(file).Open(); }

}  // namespace scoria::logs
