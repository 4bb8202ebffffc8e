// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/definition_source.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/files.h"
#include "logs/ros/idl_parser.h"
#include "logs/ros/msg_parser.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

bool IsKindFolder(const fs::path& name) { return name == "msg" || name == "idl"; }

/// The package of a file in `folder`; empty where any will do.
std::string PackageOf(const fs::path& file, const fs::path& folder) {
  const fs::path parent = file.parent_path();
  if (IsKindFolder(parent.filename())) return parent.parent_path().filename();
  return parent == folder ? std::string() : parent.filename().string();
}

std::vector<MessageDefinition> ParseFile(const fs::path& file, const std::string& type) {
  const std::string text = core::ReadText(file);
  if (file.extension() == ".msg") return {ParseMsg(text, type, file.string())};
  std::vector<MessageDefinition> messages = ParseIdl(text, file.string());
  std::erase_if(messages,
                [&](const auto& m) { return ShortTypeName(m.name) != ShortTypeName(type); });
  return messages;
}

/// .msg files first.
void SortFiles(DefinitionFiles::Files& files) {
  for (auto& [key, paths] : files) {
    std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
      return std::pair(a.extension() != ".msg", a) < std::pair(b.extension() != ".msg", b);
    });
  }
}

}  // namespace

ListedDefinitions::ListedDefinitions(std::string name, std::vector<MessageDefinition> messages)
    : name_(std::move(name)), messages_(std::move(messages)) {
  for (std::size_t i = 0; i < messages_.size(); ++i) index_.emplace(messages_[i].name, i);
}

std::vector<MessageDefinition> ListedDefinitions::Find(const std::string& type) const {
  if (const auto exact = index_.find(type); exact != index_.end())
    return {messages_[exact->second]};
  return {};
}

DefinitionFiles::DefinitionFiles(std::string name, Files files)
    : name_(std::move(name)), files_(std::move(files)) {
  SortFiles(files_);
}

std::vector<MessageDefinition> DefinitionFiles::Find(const std::string& type) const {
  const std::string short_name(ShortTypeName(type));
  std::vector<MessageDefinition> found;
  for (const std::string& key : {type.substr(0, type.find('/')) + "/" + short_name, short_name}) {
    const auto files = files_.find(key);
    if (files == files_.end()) continue;
    for (const fs::path& file : files->second) {
      for (MessageDefinition& message : ParseFile(file, type)) {
        message.name = type;
        found.push_back(std::move(message));
      }
    }
  }
  return found;
}

DefinitionFolder ScanDefinitionFolder(const fs::path& given) {
  const std::string name = fmt::format("--msg-path {}", given.string());
  std::error_code error;
  const fs::path folder = fs::canonical(given, error);
  if (error || !fs::is_directory(folder, error)) {
    throw DefinitionError(fmt::format("{}: no such folder", name));
  }
  DefinitionFiles::Files packages, loose;
  const auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
    const fs::path& file = entry.path();
    if (!entry.is_regular_file(error)) continue;
    if (file.extension() != ".msg" && file.extension() != ".idl") continue;
    const std::string package = PackageOf(file, folder);
    const std::string stem = file.stem().string();
    (package.empty() ? loose[stem] : packages[package + "/" + stem]).push_back(file);
  }
  if (packages.empty() && loose.empty()) {
    throw DefinitionError(fmt::format("{}: holds no .msg or .idl file", name));
  }
  return {{name, std::move(packages)}, {name, std::move(loose)}};
}

}  // namespace scoria::logs
