// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/derived_defaults.h"

#include <fmt/format.h>

#include "app/scenario/scenario.h"
#include "core/config/archive.h"
#include "core/config/scale.h"

namespace scoria::app {
namespace {

/// Two trees of one type, leaf by leaf.
void AddDifferences(const core::ConfigNode& go2, const core::ConfigNode& robot,
                    const std::string& key, std::vector<DerivedDefault>& out) {
  if (go2.kind == core::ConfigNode::Kind::kScalar && go2.scalar != robot.scalar)
    out.push_back({key, go2.scalar, robot.scalar});
  for (std::size_t i = 0; i < go2.items.size(); ++i)
    AddDifferences(go2.items[i], robot.items[i], fmt::format("{}[{}]", key, i), out);
  for (std::size_t i = 0; i < go2.entries.size(); ++i) {
    const std::string& name = go2.entries[i].key;
    AddDifferences(go2.entries[i].value, robot.entries[i].value,
                   key.empty() ? name : key + "." + name, out);
  }
}

}  // namespace

std::vector<DerivedDefault> DerivedDefaults(const core::Similarity& similarity) {
  std::vector<DerivedDefault> out;
  AddDifferences(core::WriteConfig(Scenario{}),
                 core::WriteConfig(core::Scaled(Scenario{}, similarity)), "", out);
  return out;
}

}  // namespace scoria::app
