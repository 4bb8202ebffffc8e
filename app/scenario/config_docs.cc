// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/config_docs.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/campaign/campaign_file.h"
#include "app/scenario/config_kinds.h"
#include "app/scenario/scenario.h"
#include "core/demand.h"
#include "logs/mapping/mapping_file.h"

namespace scoria::app {
namespace {

using core::FieldInfo;
using nlohmann::json;

constexpr const char* kMapByName = "map by name";

std::string Range(const FieldInfo& f) {
  if (!f.choices.empty()) return fmt::format("{}", fmt::join(f.choices, ", "));
  if (std::isinf(f.min) && std::isinf(f.max)) return "";
  return fmt::format("{} to {}", std::isinf(f.min) ? "−∞" : fmt::format("{:g}", f.min),
                     std::isinf(f.max) ? "∞" : fmt::format("{:g}", f.max));
}

/// Of the Go2; with what it is multiplied by for another robot.
std::string DefaultText(const FieldInfo& f) {
  return f.scale.empty() ? f.default_value : fmt::format("{} ∝ {}", f.default_value, f.scale);
}

/// What the keys of a signal's source allow beyond those that all have: "unit: rad, deg".
std::string ChoicesWithin(const FieldInfo& f) {
  std::string text;
  for (const FieldInfo& child : f.children) {
    if (!child.choices.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", child.key,
                          fmt::join(child.choices, ", "));
  }
  return text;
}

void AddRows(const std::vector<FieldInfo>& fields, const std::string& prefix, std::string& out) {
  for (const FieldInfo& f : fields) {
    const std::string key = prefix + f.key;
    if (f.has_short_form) {
      out += fmt::format("| `{}` | source | {} | {} | {} |\n", key, f.required ? "required" : "",
                         ChoicesWithin(f), f.doc);
      continue;
    }
    const bool nested = !f.children.empty();
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", key, f.kind,
                       f.required                     ? "required"
                       : nested && f.kind == "struct" ? ""
                                                      : DefaultText(f),
                       Range(f), f.doc);
    if (f.kind == "variant") {
      for (const FieldInfo& alternative : f.children) {
        out += fmt::format("| `{}.type: {}` | | | | |\n", key, alternative.key);
        AddRows(alternative.children, key + ".", out);
      }
    } else if (f.kind == "list") {
      AddRows(f.children.front().children, key + "[].", out);
    } else if (f.kind == kMapByName) {
      AddRows(f.children.front().children, key + ".NAME.", out);
    } else {
      AddRows(f.children, key + ".", out);
    }
  }
}

constexpr const char* kScenarioRef = "#/$defs/scenario";  // maps are of scenario keys, in campaigns

json Schema(const FieldInfo& f);

json ObjectSchema(const std::vector<FieldInfo>& fields) {
  json object = {
      {"type", "object"}, {"additionalProperties", false}, {"properties", json::object()}};
  for (const FieldInfo& f : fields) object["properties"][f.key] = Schema(f);
  object["properties"]["base"] = {{"type", "string"},
                                  {"description", "YAML file to start from, relative to this one"}};
  return object;
}

/// A list; overrides reach its items by number, as a map.
json ListSchema(const json& items) {
  return {{"type", {"array", "object"}},
          {"items", items},
          {"patternProperties", {{"^[0-9]+$", items}}},
          {"additionalProperties", false}};
}

/// One alternative's keys; the type may come from a base, so that none is required.
json VariantSchema(const FieldInfo& f) {
  json any = json::array();
  for (const FieldInfo& alternative : f.children) {
    json object = ObjectSchema(alternative.children);
    object["properties"]["type"] = {{"const", alternative.key}};
    any.push_back(std::move(object));
  }
  return {{"anyOf", std::move(any)}};
}

json Schema(const FieldInfo& f) {
  json schema = json::object();
  if (f.kind == "bool") schema["type"] = "boolean";
  if (f.kind == "integer") schema["type"] = "integer";
  if (f.kind == "number") schema["type"] = "number";
  if (f.kind == "string" || f.kind == "path") schema["type"] = "string";
  if (f.kind == "choice") schema["enum"] = f.choices;
  if (f.kind == "map") schema["$ref"] = kScenarioRef;
  if (f.kind == "list") {
    schema = ListSchema(Schema(f.children.front()));
  } else if (f.kind.starts_with("list")) {
    schema = ListSchema({{"type", f.kind.ends_with("strings") ? "string" : "number"}});
  }
  if (f.kind == "integer" || f.kind == "number") {
    if (std::isfinite(f.min)) schema["minimum"] = f.min;
    if (std::isfinite(f.max)) schema["maximum"] = f.max;
  }
  if (f.kind == "struct") schema = ObjectSchema(f.children);
  if (f.kind == kMapByName)
    schema = {{"type", "object"}, {"additionalProperties", Schema(f.children.front())}};
  if (f.has_short_form) {
    json any = json::array({schema});
    for (const bool list : {false, true}) {  // what stands for the struct is its first of the kind
      const auto child = std::find_if(f.children.begin(), f.children.end(), [&](const auto& c) {
        return c.kind.starts_with("list") == list;
      });
      any.push_back(Schema(*child));
    }
    schema = {{"anyOf", std::move(any)}};
  }
  if (f.kind == "variant") schema = VariantSchema(f);
  if (!f.doc.empty()) schema["description"] = f.doc;
  return schema;
}

}  // namespace

std::string ConfigMarkdown() {
  constexpr const char* kHeader =
      "| key | kind | default | range | meaning |\n|---|---|---|---|---|\n";
  std::string out = fmt::format(
      "# Scenario keys\n\n"
      "Generated by `scoria schema --markdown`; a test keeps it current. Every key with its kind, "
      "default, allowed range and meaning.\n"
      "Any map may say `base: other.yaml` (relative to the file that says it) and override single "
      "keys. A map that names a `base`, or\n"
      "whose `type` differs, replaces an inherited one whole. `scoria schema [KIND]` prints a JSON "
      "Schema for editors.\n\n{}",
      kHeader);
  AddRows(core::DescribeConfig<Scenario>().children, "", out);
  out += fmt::format("\n# Campaign keys\n\n{}", kHeader);
  AddRows(core::DescribeConfig<CampaignFile>().children, "", out);
  out += fmt::format("\nA design in place of a list of axes:\n\n{}", kHeader);
  AddRows(core::DescribeConfig<DesignFile>().children, "sweep.", out);
  out += fmt::format(
      "\n# Mapping keys\n\nOf mappings from recorded messages to rows; "
      "[mappings.md](mappings.md) explains them. A source is the path of a field or "
      "the name of a column,\na list of them, or a map, here of a velocity:\n\n{}",
      kHeader);
  AddRows(core::DescribeConfig<logs::FramedSource<logs::SpeedUnit>>().children, "SOURCE.", out);
  out += "\n" + std::string(kHeader);
  AddRows(core::DescribeConfig<logs::MappingFile>().children, "", out);
  return out;
}

std::string ConfigJsonSchema(std::string_view kind) {
  const std::span<const ConfigKind> kinds = ConfigKinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const ConfigKind& k) { return k.name == kind; });
  SCORIA_DEMAND(found != kinds.end(), "{}", kind);
  json schema = Schema(found->describe());
  if (kind == "campaign") {
    schema["$defs"]["scenario"] = ObjectSchema(core::DescribeConfig<Scenario>().children);
    json& sweep = schema["properties"]["sweep"];
    sweep = {{"anyOf", {sweep, Schema(core::DescribeConfig<DesignFile>())}}};
  }
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = fmt::format("scoria {}", kind);
  return analysis::JsonText(schema);
}

}  // namespace scoria::app
