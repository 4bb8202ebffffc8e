// SPDX-License-Identifier: BSD-3-Clause
#include "app/export/export_csv.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/draft_file.h"
#include "core/files.h"
#include "core/text.h"
#include "logs/channel_types.h"
#include "logs/csv_line.h"
#include "logs/format/csv_log.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/flat_table.h"
#include "logs/ros/message_error.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using logs::LogChannel;
using logs::LogMessage;

/// "/scoria/row/truth" as "scoria-row-truth": topics of ROS have no dashes.
std::string FileStemOf(std::string topic) {
  if (topic.starts_with('/')) topic.erase(0, 1);
  std::replace(topic.begin(), topic.end(), '/', '-');
  return core::FileNameOf(topic);
}

/// One topic on its way to a file.
class CsvTopic {
 public:
  CsvTopic(const logs::MessageType& type, logs::FlatShape shape, const fs::path& path)
      : file_(path), table_(std::move(shape)) {
    std::vector<std::string> head = {"receive_time_s"};
    if (const auto stamp = logs::StampPathOf(type)) {
      stamp_.emplace(type, std::vector<std::string>{*stamp});
      head.emplace_back("header_time_s");
    }
    head.insert(head.end(), table_.columns().begin(), table_.columns().end());
    file_.Append(logs::CsvLine(head));
  }

  void Add(const LogMessage& m) {
    try {
      std::vector<std::string> cells = {logs::SecondsText(m.log_time_ns)};
      if (stamp_) cells.push_back(logs::SecondsText(stamp_->Read(m.data)[0].Int()));
      const std::span<const std::string> fields = table_.Read(m.data);
      cells.insert(cells.end(), fields.begin(), fields.end());
      file_.Append(logs::CsvLine(cells));
      ++rows_;
    } catch (const logs::MessageError& error) {
      if (undecoded_++ == 0) why_ = error.what();
    }
  }

  [[nodiscard]] ExportedFile Publish() {
    file_.Publish();
    return {file_.path(), rows_};
  }

  /// Empty if every message became a row.
  [[nodiscard]] std::string Remark() const {
    if (undecoded_ == 0) return "";
    return fmt::format("{} of {} messages cannot be decoded and are left out: {}", undecoded_,
                       undecoded_ + rows_, why_);
  }

 private:
  core::DraftFile file_;
  logs::FlatTable table_;
  std::optional<logs::FieldReader> stamp_;
  std::uint64_t rows_ = 0, undecoded_ = 0;
  std::string why_;
};

class CsvExport {
 public:
  explicit CsvExport(const ExportOptions& options)
      : options_(options),
        source_(OpenExport(options)),
        types_(logs::ResolveTypes(source_.log->contents(), logs::TypeResolver(options.msg_paths))),
        counts_(types_.size(), 0),
        shapes_(types_.size()),
        topics_(types_.size()) {}

  ExportResult Run() {
    ForEach([&](const LogMessage& m) {
      ++counts_[m.channel_index];
      types_[m.channel_index].Show(m.data);
    });
    MakeShapes();
    Measure();
    if (!IsInterrupted(options_)) OpenFiles();
    ForEach([&](const LogMessage& m) {
      if (auto& topic = topics_[m.channel_index]) topic->Add(m);
    });
    return Finish();
  }

 private:
  template <class Consume>
  void ForEach(const Consume& consume) {
    source_.log->ForEach(source_.filter, [&](const LogMessage& m) {
      if (IsInterrupted(options_)) return false;
      consume(m);
      return true;
    });
  }

  [[nodiscard]] const LogChannel& ChannelOf(std::size_t i) const {
    return source_.log->contents().channels[i];
  }

  void Remark(std::size_t channel, const std::string& text) {
    result_.remarks.push_back(fmt::format("{}: {}", core::Shown(ChannelOf(channel).topic), text));
  }

  void MakeShapes() {
    for (std::size_t i = 0; i < types_.size(); ++i) {
      if (counts_[i] == 0) continue;
      if (ChannelOf(i).message_encoding == logs::kCsvEncoding) {
        Remark(i, "left out: it is CSV already; --signals writes its canonical signals");
      } else if (const logs::TypeCandidate* const taken = types_[i].taken()) {
        shapes_[i].emplace(taken->type);
      } else {
        Remark(i, "left out: " + types_[i].Report());
      }
    }
  }

  void Measure() {
    const bool varies = std::any_of(shapes_.begin(), shapes_.end(),
                                    [](const auto& shape) { return shape && shape->varies(); });
    if (!varies) return;
    ForEach([&](const LogMessage& m) {
      auto& shape = shapes_[m.channel_index];
      if (!shape || !shape->varies()) return;
      try {
        shape->Measure(m.data);
      } catch (const logs::MessageError&) {
        // no row, which Add says
      }
    });
  }

  void OpenFiles() {
    const std::vector<std::pair<std::size_t, fs::path>> targets = Targets();
    if (targets.empty()) ThrowNothing();
    for (const auto& [channel, path] : targets) CheckTarget(path, options_);
    if (const fs::path folder = targets[0].second.parent_path(); !folder.empty())
      core::CreateFolders(folder);
    for (const auto& [channel, path] : targets)
      topics_[channel] = std::make_unique<CsvTopic>(types_[channel].taken()->type,
                                                    std::move(*shapes_[channel]), path);
  }

  /// The files to write, by channel.
  [[nodiscard]] std::vector<std::pair<std::size_t, fs::path>> Targets() const {
    std::vector<std::pair<std::size_t, fs::path>> targets;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (!shapes_[i]) continue;
      const std::string stem = FileStemOf(ChannelOf(i).topic);
      std::string name = stem;
      for (int number = 2; !taken.insert(name).second; ++number)
        name = fmt::format("{}-{}", stem, number);
      targets.emplace_back(i, options_.out / (name + ".csv"));
    }
    if (options_.out.extension() != ".csv") return targets;
    if (targets.size() > 1)
      throw std::runtime_error(fmt::format(
          "{}: {} topics do not fit into one file; name a folder, or one topic with --topics",
          options_.out.string(), targets.size()));
    for (auto& target : targets) target.second = options_.out;
    return targets;
  }

  [[noreturn]] void ThrowNothing() const {
    if (result_.remarks.empty())
      throw std::runtime_error(
          fmt::format("{}: has no message in what is asked for", options_.log.string()));
    throw std::runtime_error(fmt::format("{}: no topic can be decoded; {}", options_.log.string(),
                                         fmt::join(result_.remarks, "; ")));
  }

  ExportResult Finish() {
    for (std::string& problem : source_.Problems()) result_.remarks.push_back(std::move(problem));
    result_.was_interrupted = IsInterrupted(options_);
    if (result_.was_interrupted) return std::move(result_);
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (!topics_[i]) continue;
      result_.files.push_back(topics_[i]->Publish());
      if (const std::string remark = topics_[i]->Remark(); !remark.empty()) Remark(i, remark);
    }
    return std::move(result_);
  }

  const ExportOptions& options_;
  ExportSource source_;
  // By channel:
  std::vector<logs::TypeChoice> types_;
  std::vector<std::uint64_t> counts_;  // messages wanted
  std::vector<std::optional<logs::FlatShape>> shapes_;
  std::vector<std::unique_ptr<CsvTopic>> topics_;
  ExportResult result_;
};

}  // namespace

ExportResult ExportCsv(const ExportOptions& options) { return CsvExport(options).Run(); }

}  // namespace scoria::app
