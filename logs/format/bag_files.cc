// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/bag_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

bool IsPacked(const fs::path& file) {
  return file.extension() == ".zstd" || file.extension() == ".zst";
}
/// The file's name before it was compressed.
fs::path PlainName(const fs::path& file) { return IsPacked(file) ? file.stem() : file.filename(); }

/// The recording that a file is a split of: "walk" for walk_3.db3.zstd.
std::string SplitStem(const fs::path& file) {
  std::string stem = PlainName(file).stem();
  const std::size_t digits = stem.find_last_not_of("0123456789");
  const bool is_split =
      digits != std::string::npos && digits + 1 < stem.size() && stem[digits] == '_';
  return is_split ? stem.substr(0, digits) : stem;
}

/// 10 comes behind 9.
bool IsEarlierName(const fs::path& a, const fs::path& b) {
  const std::string x = PlainName(a).stem(), y = PlainName(b).stem();
  if (SplitStem(a) == SplitStem(b) && x.size() != y.size()) return x.size() < y.size();
  return x < y;
}

/// Looks over one folder.
class Finder {
 public:
  explicit Finder(const fs::path& folder) : folder_(folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string extension = PlainName(entry.path()).extension();
      if (entry.is_regular_file() && (extension == ".db3" || extension == ".mcap"))
        present_.push_back(entry.path());
    }
    std::sort(present_.begin(), present_.end(), IsEarlierName);
  }

  BagFiles Find() {
    ReadMetadata();
    if (found_.metadata) TakeNamed();
    if (found_.files.empty()) {
      CheckOneKind();
      found_.files = present_;
    } else {
      TakeFurtherSplits();
    }
    DropPackedTwins();
    return std::move(found_);
  }

 private:
  void ReadMetadata() {
    const fs::path& file = found_.metadata_file = folder_ / kBagMetadata;
    if (!fs::exists(file)) return;
    try {
      found_.metadata = ReadBagMetadata(file);
    } catch (const std::runtime_error& e) {
      std::string what = e.what();
      if (what.starts_with(file.string())) what.erase(0, file.string().size() + 1);
      Report(LogProblem::Kind::kOdd, fmt::format("is not used: {}", what));
    }
  }

  void TakeNamed() {
    std::vector<std::string> missing;
    for (const std::string& name : found_.metadata->files) {
      if (const std::optional<fs::path> file = Resolve(name)) {
        if (!IsTaken(*file)) found_.files.push_back(*file);
      } else {
        missing.push_back(name);
      }
    }
    // Where none is there, the files have other names now.
    if (!missing.empty())
      Report(found_.files.empty() && !present_.empty() ? LogProblem::Kind::kOdd
                                                       : LogProblem::Kind::kLost,
             fmt::format("names files that are not there: {}", fmt::join(missing, ", ")));
  }

  /// Older versions write the bag's folder before the name, and compression adds to the name or,
  /// where it did not come to its end, has yet to.
  [[nodiscard]] std::optional<fs::path> Resolve(const fs::path& name) const {
    if (name.empty()) return std::nullopt;
    for (const fs::path& base :
         {folder_ / PlainName(name), (folder_ / name).parent_path() / PlainName(name)}) {
      for (const char* suffix : {"", ".zstd", ".zst"}) {
        const fs::path file = base.string() + suffix;
        if (fs::is_regular_file(file)) return file;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool IsTaken(const fs::path& file) const {
    return std::find(found_.files.begin(), found_.files.end(), file) != found_.files.end();
  }

  void TakeFurtherSplits() {
    std::set<std::string> stems, names;
    for (const fs::path& file : found_.files) {
      stems.insert(SplitStem(file));
      names.insert(PlainName(file));
    }
    const std::string extension = PlainName(found_.files.front()).extension();
    for (const fs::path& file : present_) {
      if (names.contains(PlainName(file))) continue;
      const bool is_split =
          stems.contains(SplitStem(file)) && PlainName(file).extension() == extension;
      if (is_split) found_.files.push_back(file);
      Report(LogProblem::Kind::kOdd,
             fmt::format("does not name {}, which {}", file.filename().string(),
                         is_split ? "was read, too" : "was left alone"));
    }
  }

  void CheckOneKind() const {
    std::map<std::string, std::vector<std::string>> by_kind;
    for (const fs::path& file : present_)
      by_kind[PlainName(file).extension()].push_back(file.filename());
    if (by_kind.size() < 2) return;
    throw std::runtime_error(fmt::format(
        "{}: holds {} and {}, and no metadata.yaml that says which are the bag; give one of the "
        "files",
        folder_.string(), fmt::join(by_kind.begin()->second, ", "),
        fmt::join(by_kind.rbegin()->second, ", ")));
  }

  /// A player unpacks beside the packed file; a recorder that was killed leaves a part of one.
  void DropPackedTwins() {
    std::set<fs::path> plain;
    for (const fs::path& file : found_.files) {
      if (!IsPacked(file)) plain.insert(file);
    }
    std::erase_if(found_.files, [&](const fs::path& file) {
      return IsPacked(file) && plain.contains(file.parent_path() / PlainName(file));
    });
  }

  void Report(LogProblem::Kind kind, std::string what) {
    found_.problems.push_back({kind, found_.metadata_file, std::move(what)});
  }

  fs::path folder_;
  std::vector<fs::path> present_;
  BagFiles found_;
};

}  // namespace

BagFiles FindBagFiles(const fs::path& folder) { return Finder(folder).Find(); }

std::string FolderSummary(const fs::path& folder) {
  std::map<std::string, int> counts;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    ++counts[entry.is_directory() ? "folders"
             : extension.empty()  ? "without extension"
                                  : extension];
  }
  std::vector<std::string> texts;
  for (const auto& [kind, count] : counts) texts.push_back(fmt::format("{} {}", count, kind));
  return texts.empty() ? "nothing" : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace scoria::logs
