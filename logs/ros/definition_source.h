// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "logs/ros/definition.h"

namespace scoria::logs {

/// Where message definitions come from.
class DefinitionSource {
 public:
  virtual ~DefinitionSource() = default;

  /// What reports call it: "the bag", "--msg-path DIR", "built in, N = 20".
  [[nodiscard]] virtual const std::string& name() const noexcept = 0;

  /// The definitions of a type "pkg/msg/Name", the likeliest first; none if there is none.
  /// Errors: DefinitionError if its text cannot be read.
  [[nodiscard]] virtual std::vector<MessageDefinition> Find(const std::string& type) const = 0;
};

/// Definitions that are at hand. Of two with one name the first counts.
class ListedDefinitions : public DefinitionSource {
 public:
  ListedDefinitions(std::string name, std::vector<MessageDefinition> messages);

  [[nodiscard]] const std::string& name() const noexcept override { return name_; }
  [[nodiscard]] std::vector<MessageDefinition> Find(const std::string& type) const override;

 private:
  std::string name_;
  std::vector<MessageDefinition> messages_;
  std::map<std::string, std::size_t> index_;
};

/// Definitions in .msg and .idl files, read when they are asked for.
class DefinitionFiles : public DefinitionSource {
 public:
  /// By "pkg/Name", or by "Name" where any package will do; several files are several layouts.
  using Files = std::map<std::string, std::vector<std::filesystem::path>>;

  DefinitionFiles(std::string name, Files files);

  [[nodiscard]] const std::string& name() const noexcept override { return name_; }
  [[nodiscard]] std::vector<MessageDefinition> Find(const std::string& type) const override;

 private:
  std::string name_;
  Files files_;
};

/// The .msg and .idl files below a folder.
struct DefinitionFolder {
  DefinitionFiles packages;  // the package is the folder of a file, or the one above if it is
                             // called msg or idl
  DefinitionFiles loose;     // files right in the folder: types of any package
};

/// Errors: DefinitionError if there is no such folder, or no definition in it.
[[nodiscard]] DefinitionFolder ScanDefinitionFolder(const std::filesystem::path& folder);

/// The definitions that scoria brings along, those of logs/ros/definitions; the ones of a package
/// with several layouts are several sources.
[[nodiscard]] std::vector<ListedDefinitions> BuiltInDefinitions();

}  // namespace scoria::logs
