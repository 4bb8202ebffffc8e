// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/mapping/field_catalog.h"

namespace scoria::logs {

/// One line of a section: "  q: {field: ..., unit: deg}  # why".
struct DraftSignal {
  std::string key;
  std::string topic;
  std::string field;    // as YAML
  std::string options;  // ", unit: deg"
  std::string comment;
};

/// What was recognised in a log.
struct DraftContent {
  /// In the order in which a mapping file has them.
  std::vector<std::pair<std::string, std::vector<DraftSignal>>> sections;
  std::vector<std::string> legs, joints;  // what the log calls them; empty: it does not name them
  std::string name_field;                 // of joints
};

/// The text of a mapping file, with what is not known as comments.
[[nodiscard]] std::string DraftText(const std::vector<CatalogTopic>& topics,
                                    const LogContents& contents, const DraftContent& content);

/// A pattern in YAML: quoted where YAML would take it for something else.
[[nodiscard]] std::string QuotedInYaml(const std::string& text);

/// Lower-case words of a text, placeholders and digits left out.
[[nodiscard]] std::vector<std::string> WordsOf(const std::string& text);

[[nodiscard]] bool HasAny(const std::vector<std::string>& words,
                          std::initializer_list<std::string_view> some);

}  // namespace scoria::logs
