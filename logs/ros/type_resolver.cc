// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/type_resolver.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/check_message.h"
#include "logs/ros/idl_parser.h"
#include "logs/ros/message_error.h"
#include "logs/ros/msg_parser.h"

namespace scoria::logs {
namespace {

std::vector<MessageDefinition> ParseOwn(const ChannelSchema& channel, const std::string& type) {
  const std::string source = fmt::format("the bag's definition of {}", type);
  if (channel.schema_encoding != "ros2idl") return ParseRos2Msg(channel.schema_text, type, source);
  std::vector<MessageDefinition> messages = ParseIdl(channel.schema_text, source);
  const auto is_named = [&](const MessageDefinition& m) { return m.name == type; };
  const auto is_short = [&](const MessageDefinition& m) {
    return ShortTypeName(m.name) == ShortTypeName(type);
  };
  if (std::none_of(messages.begin(), messages.end(), is_named) &&
      std::count_if(messages.begin(), messages.end(), is_short) == 1) {
    std::find_if(messages.begin(), messages.end(), is_short)->name = type;  // in other modules
  }
  return messages;
}

std::string Joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + "; " + b;
}

struct SourceRef {
  const DefinitionSource* definitions;
  bool any_package;
  bool is_log;
};

std::string_view PackageOf(std::string_view type) { return type.substr(0, type.find('/')); }

/// Collects the candidates for a type from sources in order.
class CandidateFinder {
 public:
  CandidateFinder(std::vector<SourceRef> sources, std::string problem)
      : sources_(std::move(sources)), problem_(std::move(problem)) {}

  TypeChoice Find(const std::string& type) {
    for (const SourceRef& source : sources_) {
      try {
        for (const MessageDefinition& root : source.definitions->Find(type)) Add(root, source);
      } catch (const DefinitionError& error) {
        problem_ = Joined(problem_, error.what());
      }
    }
    if (candidates_.empty() && problem_.empty()) {
      problem_ = fmt::format("no definition of {} in the bag, below --msg-path or built in", type);
    }
    return {type, std::move(candidates_), std::move(problem_)};
  }

 private:
  /// Once, or with both widths of the characters of a wstring; not if it is there already.
  void Add(const MessageDefinition& root, const SourceRef& source) {
    const TypeCandidate candidate = MakeCandidate(root, source);
    if (!candidate.type.has_wstring()) return AddIfNew(candidate);
    for (const int bytes : {4, 2}) {
      TypeCandidate one = candidate;
      one.type = candidate.type.WithWideChars(bytes);
      one.origin += fmt::format(", wstring of {}-byte characters", bytes);
      AddIfNew(std::move(one));
    }
  }

  void AddIfNew(TypeCandidate candidate) {
    const auto is_same = [&](const TypeCandidate& other) { return other.type == candidate.type; };
    if (std::any_of(candidates_.begin(), candidates_.end(), is_same)) return;
    candidates_.push_back(std::move(candidate));
  }

  [[nodiscard]] TypeCandidate MakeCandidate(const MessageDefinition& root,
                                            const SourceRef& primary) const {
    std::set<std::string> borrowed;
    const auto find = [&](const std::string& type) -> std::optional<MessageDefinition> {
      const bool is_kin = !primary.any_package || PackageOf(type) == PackageOf(root.name);
      if (is_kin) {
        if (auto found = primary.definitions->Find(type); !found.empty()) return found[0];
      }
      for (const bool any_package : {false, true}) {
        for (const SourceRef& source : sources_) {
          if (source.any_package != any_package) continue;
          const auto found = source.definitions->Find(type);
          if (found.empty()) continue;
          borrowed.insert(fmt::format(", {} {}", type, source.definitions->name()));
          return found[0];
        }
      }
      return std::nullopt;
    };
    MessageType type(root, find);
    // A log's definition should be whole; what scoria and the user bring along is put together.
    std::string origin = primary.definitions->name();
    if (primary.is_log) origin += fmt::format("{}", fmt::join(borrowed, ""));
    const bool is_own = primary.is_log && borrowed.empty();
    return {std::move(type), std::move(origin), is_own, 0, 0, "", 0};
  }

  std::vector<SourceRef> sources_;
  std::vector<TypeCandidate> candidates_;
  std::string problem_;
};

/// Why messages of a channel are not decoded, whatever their definition; empty if they are.
std::string RefusalOf(const ChannelSchema& channel) {
  if (channel.message_encoding != "cdr") {
    return fmt::format("encoding \"{}\" is not decoded (cdr is)",
                       core::Shown(channel.message_encoding));
  }
  const std::string& schema = channel.schema_encoding;
  if (schema.empty() || schema == "ros2msg" || schema == "ros2idl") return "";
  return fmt::format("schema encoding \"{}\" is not decoded (ros2msg and ros2idl are)",
                     core::Shown(schema));
}

/// The log's own, and no guess at how its vendor writes text.
bool IsTrusted(const TypeCandidate& candidate) {
  return candidate.is_own && !candidate.type.has_wstring();
}

}  // namespace

TypeChoice::TypeChoice(std::string type_name, std::vector<TypeCandidate> candidates,
                       std::string problem)
    : type_name_(std::move(type_name)),
      candidates_(std::move(candidates)),
      problem_(std::move(problem)) {}

bool TypeChoice::IsSettled() const noexcept {
  if (candidates_.empty()) return true;
  const TypeCandidate& first = candidates_.front();
  return IsTrusted(first) && first.fits > 0 && first.misfits == 0 && first.with_rest == 0;
}

void TypeChoice::Show(std::span<const std::byte> message) {
  if (IsSettled()) return;
  ++shown_;
  for (TypeCandidate& candidate : candidates_) {
    if (candidate.misfits > 0 && !candidate.is_own) continue;
    try {
      if (!IsTrusted(candidate)) {
        CheckMessage(candidate.type, message);
      } else if (MeasureRest(candidate.type, message) > kMostPadding) {
        ++candidate.with_rest;
      }
      ++candidate.fits;
    } catch (const MessageError& error) {
      if (candidate.misfits++ == 0) candidate.first_misfit = error.what();
    }
  }
}

const TypeCandidate* TypeChoice::taken() const noexcept {
  const TypeCandidate* some = nullptr;
  for (const TypeCandidate& candidate : candidates_) {
    if (candidate.misfits == 0) return &candidate;
    const bool is_better = some == nullptr || candidate.fits > some->fits;
    if (candidate.is_own && candidate.fits > 0 && is_better) some = &candidate;
  }
  return some;
}

std::string TypeChoice::Report() const {
  const TypeCandidate* choice = taken();
  if (choice != nullptr) {
    std::string report = choice->origin;
    if (choice->misfits > 0) {
      report += fmt::format(" ({} of {} messages do not fit it: {})", choice->misfits, shown_,
                            choice->first_misfit);
    }
    if (choice->with_rest > 0) {
      report += fmt::format(" (bytes are left behind its last field in {} of {} messages)",
                            choice->with_rest, shown_);
    }
    for (const TypeCandidate& other : candidates_) {
      if (&other == choice || other.misfits > 0 || other.fits == 0) continue;
      report += fmt::format("; {} fits as well", other.origin);
    }
    return Joined(report, problem_);
  }
  std::string misfits;
  for (const TypeCandidate& candidate : candidates_) {
    misfits = Joined(misfits, fmt::format("{}: {}", candidate.origin, candidate.first_misfit));
  }
  if (!misfits.empty()) misfits = fmt::format("no definition of {} fits: {}", type_name_, misfits);
  return Joined(misfits, problem_);
}

TypeResolver::TypeResolver(const std::vector<std::filesystem::path>& msg_paths) {
  for (const std::filesystem::path& path : msg_paths) {
    DefinitionFolder folder = ScanDefinitionFolder(path);
    sources_.push_back({std::make_unique<DefinitionFiles>(std::move(folder.packages)), false});
    sources_.push_back({std::make_unique<DefinitionFiles>(std::move(folder.loose)), true});
  }
  for (ListedDefinitions& listed : BuiltInDefinitions()) {
    sources_.push_back({std::make_unique<ListedDefinitions>(std::move(listed)), false});
  }
}

TypeChoice TypeResolver::Resolve(const ChannelSchema& channel) const {
  const std::string type = FullTypeName(channel.type_name);
  if (std::string refusal = RefusalOf(channel); !refusal.empty()) {
    return {type, {}, std::move(refusal)};
  }
  std::optional<ListedDefinitions> own;
  std::string problem;
  try {
    if (!channel.schema_encoding.empty()) own.emplace("the bag", ParseOwn(channel, type));
  } catch (const DefinitionError& error) {
    problem = error.what();
  }
  std::vector<SourceRef> sources;
  if (own) sources.push_back({&*own, false, true});
  for (const Source& source : sources_) {
    sources.push_back({source.definitions.get(), source.any_package, false});
  }
  return CandidateFinder(std::move(sources), std::move(problem)).Find(type);
}

}  // namespace scoria::logs
