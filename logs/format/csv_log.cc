// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/csv_log.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <stdexcept>

#include <fmt/format.h>

#include "core/file_kind.h"
#include "logs/format/line_reader.h"
#include "logs/format/random_access_file.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSeparatorKey = "separator";
constexpr const char* kColumnsKey = "columns";
constexpr const char* kClockKey = "clock_column";
constexpr std::uint64_t kHeadBytes = 64 << 10;

std::optional<CsvDialect> DialectOf(const RandomAccessFile& file) {
  const Bytes head = file.Read(0, kHeadBytes);
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  if (!core::KindOfContent(text).name.empty()) return std::nullopt;
  return DetectCsv(text, head.size() == file.size());
}

std::string_view NameOfSeparator(char separator) {
  if (separator == kSpaces) return "spaces";
  return separator == '\t' ? "tab" : separator == ';' ? ";" : ",";
}

struct CsvFile {
  explicit CsvFile(const fs::path& path) : file(path) {}
  RandomAccessFile file;
  CsvDialect dialect;
  std::size_t channel = 0;
};

/// Goes through the lines of data of one file.
class LineCursor {
 public:
  LineCursor(const CsvFile& file, const LogContents& contents, std::vector<LogProblem>& problems)
      : file_(file),
        contents_(contents),
        problems_(problems),
        lines_(file.file),
        splitter_(file.dialect.separator) {
    for (std::size_t i = 0; i < file.dialect.num_lead_lines; ++i) (void)lines_.Next();
    Advance();
  }

  [[nodiscard]] bool HasLine() const { return line_.has_value(); }
  [[nodiscard]] std::int64_t time_ns() const { return time_ns_; }
  [[nodiscard]] std::size_t channel() const { return file_.channel; }

  /// Valid until Advance. @pre HasLine.
  [[nodiscard]] LogMessage Message() const {
    return {file_.channel, contents_.channels[file_.channel],
            time_ns_,      std::nullopt,
            std::nullopt,  std::as_bytes(std::span(line_->data(), line_->size()))};
  }

  void Advance() {
    while ((line_ = lines_.Next())) {
      if (!IsCsvData(*line_)) continue;
      const std::span<const std::string_view> fields = splitter_.Split(*line_);
      if (fields.size() == file_.dialect.columns && TakeTime(fields)) return;
      const bool is_cut = lines_.IsAtEnd() && fields.size() <= file_.dialect.columns;
      if (is_cut) {
        Report(LogProblem::Kind::kCut, fmt::format("the last line, {}, is cut", lines_.number()));
      } else {
        NoteBadLine(fields.size());
      }
    }
    if (lines_.has_too_long_line())
      Report(LogProblem::Kind::kLost, "a line is longer than 16 MiB: no more is read");
    ReportBadLines();
  }

 private:
  bool TakeTime(std::span<const std::string_view> fields) {
    const std::optional<CsvClock>& clock = file_.dialect.clock;
    time_ns_ = static_cast<std::int64_t>(lines_.number());
    if (!clock) return true;
    const auto time = ParseCsvTime(fields[clock->column], clock->unit_ns);
    if (time) time_ns_ = *time;
    return time.has_value();
  }

  void NoteBadLine(std::size_t fields) {
    if (num_bad_++ > 0) return;
    first_bad_ = fields == file_.dialect.columns
                     ? fmt::format("line {}, which has no time", lines_.number())
                     : fmt::format("line {}, which has {} fields in place of {}", lines_.number(),
                                   fields, file_.dialect.columns);
  }

  void ReportBadLines() {
    if (num_bad_ == 0) return;
    Report(LogProblem::Kind::kLost,
           num_bad_ == 1
               ? fmt::format("{}, is left out", first_bad_)
               : fmt::format("{} lines are left out, the first is {}", num_bad_, first_bad_));
    num_bad_ = 0;
  }

  void Report(LogProblem::Kind kind, std::string what) {
    LogProblem problem{kind, file_.file.path(), std::move(what)};
    if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
      problems_.push_back(std::move(problem));
  }

  const CsvFile& file_;
  const LogContents& contents_;
  std::vector<LogProblem>& problems_;
  LineReader lines_;
  CsvSplitter splitter_;
  std::optional<std::string_view> line_;
  std::int64_t time_ns_ = 0;
  std::uint64_t num_bad_ = 0;
  std::string first_bad_;
};

/// Merges the lines of files by their times, equal times in the order of the files.
class CsvCursor final : public LogCursor {
 public:
  explicit CsvCursor(LogFilter filter) : filter_(std::move(filter)) {}

  void Add(const CsvFile& file, const LogContents& contents, std::vector<LogProblem>& problems) {
    files_.emplace_back(file, contents, problems);
  }

  [[nodiscard]] std::optional<LogMessage> Next() override {
    for (;;) {
      if (current_ != nullptr) current_->Advance();
      current_ = nullptr;
      for (LineCursor& file : files_) {
        if (!file.HasLine()) continue;
        if (current_ == nullptr || file.time_ns() < current_->time_ns()) current_ = &file;
      }
      if (current_ == nullptr) return std::nullopt;
      const std::int64_t time_ns = current_->time_ns();
      if (time_ns >= filter_.from_ns && time_ns <= filter_.to_ns) return current_->Message();
    }
  }

 private:
  LogFilter filter_;
  std::deque<LineCursor> files_;
  LineCursor* current_ = nullptr;  // whose line was given out
};

/// The time of the last whole line of data.
std::optional<std::int64_t> LastTime(const CsvFile& file) {
  const std::uint64_t size = file.file.size();
  const std::uint64_t from = size - std::min(size, kHeadBytes);
  const Bytes bytes = file.file.Read(from, kHeadBytes);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  CsvSplitter splitter(file.dialect.separator);
  while (!text.empty()) {
    const std::size_t end = text.rfind('\n');
    std::string_view line = end == std::string_view::npos ? text : text.substr(end + 1);
    text = end == std::string_view::npos ? "" : text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!IsCsvData(line)) continue;
    const auto fields = splitter.Split(line);
    if (fields.size() != file.dialect.columns) continue;
    const CsvClock& clock = *file.dialect.clock;
    if (const auto time = ParseCsvTime(fields[clock.column], clock.unit_ns)) return time;
  }
  return std::nullopt;
}

class CsvLog final : public LogSource {
 public:
  explicit CsvLog(const std::vector<fs::path>& paths) {
    contents_.path = paths.size() == 1 ? paths.front() : paths.front().parent_path();
    contents_.format = paths.size() == 1 ? "a CSV file" : fmt::format("{} CSV files", paths.size());
    for (const fs::path& path : paths) Add(path);
    std::vector<LogProblem> none;
    for (const CsvFile& file : files_) {
      const LineCursor first(file, contents_, none);
      if (first.HasLine()) Include(file, first.time_ns());
    }
    contents_.can_order_by_time = false;  // lines come as they are written, whatever their times
  }

  [[nodiscard]] const LogContents& contents() const override { return contents_; }
  [[nodiscard]] const std::vector<LogProblem>& problems() const override { return problems_; }

  [[nodiscard]] std::unique_ptr<LogCursor> Read(const LogFilter& filter) override {
    auto cursor = std::make_unique<CsvCursor>(filter);
    for (const CsvFile& file : files_) {
      if (filter.HasTopic(contents_.channels[file.channel].topic))
        cursor->Add(file, contents_, problems_);
    }
    return cursor;
  }

  [[nodiscard]] std::optional<LogAttachment> ReadAttachment(const std::string&) override {
    return std::nullopt;
  }

 private:
  void Add(const fs::path& path) {
    CsvFile& file = files_.emplace_back(path);
    const std::optional<CsvDialect> dialect = DialectOf(file.file);
    if (!dialect)
      throw std::runtime_error(fmt::format("{}: is no table of numbers", path.string()));
    file.dialect = *dialect;
    file.channel = contents_.channels.size();
    contents_.channels.push_back(MakeCsvChannel(path.stem().string(), *dialect));
    const std::string& topic = contents_.channels.back().topic;
    const auto has_topic = [&](const LogChannel& c) { return c.topic == topic; };
    if (std::count_if(contents_.channels.begin(), contents_.channels.end(), has_topic) > 1)
      throw std::runtime_error(
          fmt::format("{}: there are two files of the name {}", path.string(), topic));
  }

  /// Times of files without a clock are numbers of lines: they say nothing of the span.
  void Include(const CsvFile& file, std::int64_t first_ns) {
    if (!contents_.span) contents_.span = {first_ns, first_ns};
    if (!file.dialect.clock) return;
    const std::int64_t last_ns = LastTime(file).value_or(first_ns);
    contents_.span->first_ns = std::min(contents_.span->first_ns, std::min(first_ns, last_ns));
    contents_.span->last_ns = std::max(contents_.span->last_ns, std::max(first_ns, last_ns));
  }

  std::deque<CsvFile> files_;
  LogContents contents_;
  std::vector<LogProblem> problems_;
};

}  // namespace

LogChannel MakeCsvChannel(const std::string& topic, const CsvDialect& dialect) {
  LogChannel channel;
  channel.topic = topic;
  channel.message_encoding = kCsvEncoding;
  channel.schema = {std::string(kCsvEncoding), dialect.header};
  channel.metadata[kSeparatorKey] = NameOfSeparator(dialect.separator);
  channel.metadata[kColumnsKey] = fmt::to_string(dialect.columns);
  if (dialect.clock) channel.metadata[kClockKey] = fmt::to_string(dialect.clock->column);
  return channel;
}

CsvLayout CsvLayoutOf(const LogChannel& channel) {
  CsvLayout layout;
  const std::string& separator = channel.metadata.at(kSeparatorKey);
  layout.separator = separator == "spaces" ? kSpaces : separator == "tab" ? '\t' : separator[0];
  layout.columns = std::stoul(channel.metadata.at(kColumnsKey));
  if (const auto clock = channel.metadata.find(kClockKey); clock != channel.metadata.end())
    layout.clock_column = std::stoul(clock->second);
  if (!channel.schema || channel.schema->text.empty()) return layout;
  CsvSplitter splitter(layout.separator);
  for (const std::string_view name : splitter.Split(channel.schema->text))
    layout.names.emplace_back(name);
  return layout;
}

bool IsCsv(const fs::path& path) { return DialectOf(RandomAccessFile(path)).has_value(); }

std::vector<fs::path> CsvFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::string bare = name.ends_with(".zstd") ? name.substr(0, name.size() - 5) : name;
    if (bare.ends_with(".db3") || bare.ends_with(".mcap")) return {};
    const bool is_table = name.ends_with(".csv") && entry.is_regular_file() && IsCsv(entry.path());
    if (is_table) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::unique_ptr<LogSource> OpenCsv(const std::vector<fs::path>& paths) {
  return std::make_unique<CsvLog>(paths);
}

}  // namespace scoria::logs
