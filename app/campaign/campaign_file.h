// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "app/scenario/expectation.h"
#include "core/config/archive.h"

namespace scoria::app {

/// A name and the scenario keys that it changes, as a campaign's YAML has them.
struct ArmFile {
  std::string name;
  core::ConfigMap set;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Field("set", set, {.doc = "scenario keys, laid over the scenario"});
  }
};

struct AxisFile {
  std::string key, label, baseline;
  std::vector<core::ConfigNode> values;
  std::vector<ArmFile> variants;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("key", key, {.doc = "of the scenario, as operator.speed_mps"});
    a.Field("label", label, {.doc = "in figures and tables; empty: the key"});
    a.Field("baseline", baseline, {.doc = "value or variant that the others are compared with"});
    a.Field("values", values, {.doc = "of the key"});
    a.Field("variants", variants, {.doc = "in place of key and values"});
  }
};

/// A campaign's YAML file.
struct CampaignFile {
  std::string name;
  core::ConfigMap scenario;
  std::vector<ArmFile> arms;
  std::vector<AxisFile> sweep;
  std::uint64_t first_seed = 1;
  int seeds = 3;
  ArmExpectations expect;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Required("scenario", scenario, {.doc = "usually base: ../scenarios/NAME.yaml"});
    a.Required("arms", arms, {.doc = "what is compared"});
    a.Field("sweep", sweep, {.doc = "every arm walks every combination"});
    a.Field("first_seed", first_seed, {.doc = "master seed of the first episode"});
    a.Field("seeds", seeds, {.min = 1, .max = 100000, .doc = "episodes per arm and combination"});
    a.Field("expect", expect,
            {.doc = "what scoria check holds the episodes of each arm together to, by the names of "
                    "a scenario's expect; that holds for every episode"});
  }
};

}  // namespace scoria::app
