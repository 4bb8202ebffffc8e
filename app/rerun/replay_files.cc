// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay_files.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/version.h"
#include "core/math/so3.h"
#include "logs/format/cdr.h"
#include "logs/read_rows.h"

namespace scoria::app {

ReplayLogFile::ReplayLogFile(std::filesystem::path path)
    : path_(std::move(path)), writer_(core::DraftNameOf(path_)) {
  writer_.AddMetadata(logs::kRowMetadata, logs::MakeRowMetadata(kVersion));
}

template <class Group>
void ReplayLogFile::Write(const std::string& topic, double time_s,
                          const std::optional<Group>& group) {
  if (!group) return;
  using Message = logs::RowMessage<Group>;
  auto channel = channels_.find(topic);
  if (channel == channels_.end())
    channel = channels_
                  .emplace(topic, writer_.AddChannel(topic, Message::kTypeName,
                                                     logs::SchemaWriter::SchemaOf<Message>()))
                  .first;
  Message message{time_s, *group};
  logs::EncodeCdr(message, buffer_);
  writer_.Write(channel->second, std::llround(1e9 * time_s), buffer_);
}

void ReplayLogFile::AddRow(const logs::Row& row) {
  logs::ForEachGroup(row, [&]<class Group>(const std::optional<Group>& group) {
    Write(logs::TopicOf(Group::kGroup), row.time_s, group);
  });
}

void ReplayLogFile::AddVariant(const std::string& name, const logs::Row& row) {
  const std::string folder = "/replay/" + name + "/";
  Write(folder + "estimate", row.time_s, row.estimate);
  Write(folder + "contacts", row.time_s, row.contacts);
  Write(folder + "model", row.time_s, row.model);
}

std::filesystem::path ReplayLogFile::Publish() {
  writer_.Close();
  core::PublishDraft(path_);
  return path_;
}

TumFile::TumFile(const std::filesystem::path& path) : file_(path) {
  file_.Append("# time_s x_m y_m z_m qx qy qz qw\n");
}

void TumFile::Add(double time_s, const logs::Array3& p_WB_m, const logs::Array3& rpy_rad) {
  const Quat q(core::RotationFromRpy({rpy_rad[0], rpy_rad[1], rpy_rad[2]}));
  file_.Append(fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", time_s,
                           p_WB_m[0], p_WB_m[1], p_WB_m[2], q.x(), q.y(), q.z(), q.w()));
}

std::filesystem::path TumFile::Publish() {
  file_.Publish();
  return file_.path();
}

}  // namespace scoria::app
