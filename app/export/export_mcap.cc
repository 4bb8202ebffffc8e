// SPDX-License-Identifier: BSD-3-Clause
#include "app/export/export_mcap.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/draft_file.h"
#include "core/files.h"
#include "core/text.h"
#include "logs/channel_types.h"
#include "logs/format/mcap_writer.h"
#include "logs/ros/write_msg.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using logs::LogChannel;
using logs::LogMessage;

/// JSON and the like need none.
bool LacksDefinition(const LogChannel& channel) {
  return channel.message_encoding == "cdr" && (!channel.schema || channel.schema->encoding.empty());
}

/// Removes the draft of a file, unless it has its name by then.
class DraftRemover {
 public:
  explicit DraftRemover(const fs::path& path) : draft_(core::DraftNameOf(path)) {}
  ~DraftRemover() {
    std::error_code ignored;
    fs::remove(draft_, ignored);
  }
  DraftRemover(const DraftRemover&) = delete;
  DraftRemover& operator=(const DraftRemover&) = delete;

 private:
  fs::path draft_;
};

class McapExport {
 public:
  explicit McapExport(const ExportOptions& options)
      : options_(options),
        source_(OpenExport(options)),
        channels_(source_.log->contents().channels) {}

  ExportResult Run() {
    CheckTarget(options_.out, options_);
    FindDefinitions();
    if (const fs::path folder = options_.out.parent_path(); !folder.empty())
      core::CreateFolders(folder);
    const DraftRemover remover(options_.out);
    logs::McapWriter writer(core::DraftNameOf(options_.out), logs::McapWriter::kChunkBytes,
                            logs::McapCompression::kZstd, Profile());
    CopyRecords(writer);
    const std::uint64_t messages = CopyMessages(writer);
    for (std::string& problem : source_.Problems()) result_.remarks.push_back(std::move(problem));
    result_.was_interrupted = IsInterrupted(options_);
    if (result_.was_interrupted) return std::move(result_);
    writer.Close();
    core::PublishDraft(options_.out);
    result_.files.push_back({options_.out, messages});
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool IsWanted(std::size_t channel) const {
    return source_.filter.HasTopic(channels_[channel].topic);
  }

  /// For the channels that lack one.
  void FindDefinitions() {
    std::vector<std::optional<logs::TypeChoice>> types(channels_.size());
    const logs::TypeResolver resolver(options_.msg_paths);
    bool any = false;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (!IsWanted(i) || !LacksDefinition(channels_[i])) continue;
      types[i].emplace(resolver.Resolve(logs::SchemaOf(channels_[i])));
      any = true;
    }
    if (!any) return;
    source_.log->ForEach(source_.filter, [&](const LogMessage& m) {
      if (types[m.channel_index]) types[m.channel_index]->Show(m.data);
      return !IsInterrupted(options_);
    });
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (types[i]) TakeDefinition(*types[i], channels_[i]);
    }
  }

  void TakeDefinition(const logs::TypeChoice& choice, LogChannel& channel) {
    if (const logs::TypeCandidate* const taken = choice.taken()) {
      channel.schema = logs::LogSchema{"ros2msg", logs::WriteRos2Msg(taken->type)};
    } else {
      result_.remarks.push_back(
          fmt::format("{}: without a definition: {}", core::Shown(channel.topic), choice.Report()));
    }
  }

  [[nodiscard]] std::string Profile() const {
    const bool has_ros = std::any_of(channels_.begin(), channels_.end(), [](const LogChannel& c) {
      return c.message_encoding == "cdr";
    });
    return has_ros ? logs::McapWriter::kRosProfile : "";
  }

  void CopyRecords(logs::McapWriter& writer) {
    const logs::LogContents& contents = source_.log->contents();
    for (const auto& [name, metadata] : contents.metadata) writer.AddMetadata(name, metadata);
    for (const std::string& name : contents.attachments) {
      try {
        if (const auto attachment = source_.log->ReadAttachment(name))
          writer.AddAttachment(*attachment);
      } catch (const core::FileError&) {
        throw;
      } catch (const std::runtime_error& error) {
        result_.remarks.push_back(
            fmt::format("attachment {} is left out: {}", core::Shown(name), error.what()));
      }
    }
  }

  std::uint64_t CopyMessages(logs::McapWriter& writer) {
    std::vector<std::optional<std::uint16_t>> numbers(channels_.size());
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (IsWanted(i)) numbers[i] = writer.CopyChannel(channels_[i]);
    }
    std::uint64_t messages = 0;
    source_.log->ForEach(source_.filter, [&](const LogMessage& m) {
      if (IsInterrupted(options_)) return false;
      writer.Copy(numbers.at(m.channel_index).value(), m);
      ++messages;
      return true;
    });
    return messages;
  }

  const ExportOptions& options_;
  ExportSource source_;
  std::vector<LogChannel> channels_;  // as they are written
  ExportResult result_;
};

}  // namespace

ExportResult ExportMcap(const ExportOptions& options) { return McapExport(options).Run(); }

}  // namespace scoria::app
