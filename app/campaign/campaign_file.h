// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/study/design.h"
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

struct FactorFile {
  std::string key, label;
  double from = 0.0, to = 1.0;
  analysis::FactorScale scale = analysis::FactorScale::kLinear;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("key", key, {.doc = "of the scenario, a number"});
    a.Field("label", label, {.doc = "in figures and tables; empty: the key"});
    a.Required("from", from);
    a.Required("to", to);
    a.Field("scale", scale, {.doc = "even in the number, or in its logarithm"});
  }
};

/// What `sweep` is in place of a list of axes: a design over ranges of several keys.
struct DesignFile {
  analysis::DesignKind design = analysis::DesignKind::kSobol;
  int points = 128;
  std::uint64_t seed = 1;
  std::vector<FactorFile> factors;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("design", design, {.doc = "in place of axes: how points are spread over the factors"});
    a.Field("points", points,
            {.min = 3,
             .max = 1000000,
             .doc = "at most; whole rows of two more points than there are factors, which total "
                    "effects need"});
    a.Field("seed", seed, {.doc = "of the points"});
    a.Field("factors", factors);
  }
};

/// When a campaign may end before its seeds are spent.
struct StopFile {
  std::string when_decided = "falls";
  double alpha = 0.05;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("when_decided", when_decided,
            {.doc = "falls, or a metric by its key: what every arm's comparison with the first is "
                    "of, over the whole sweep, by a sequential sign test over the seeds"});
    a.Field("alpha", alpha, {.min = 1e-9, .max = 0.5, .doc = "level of each comparison"});
  }
};

/// A campaign's YAML file.
struct CampaignFile {
  std::string name;
  core::ConfigMap scenario;
  std::vector<ArmFile> arms;
  std::vector<AxisFile> sweep;  // none where there is a design
  std::uint64_t first_seed = 1;
  int seeds = 3;
  std::optional<StopFile> stop;
  ArmExpectations expect;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Required("scenario", scenario, {.doc = "usually base: ../scenarios/NAME.yaml"});
    a.Required("arms", arms, {.doc = "what is compared"});
    a.Field("sweep", sweep, {.doc = "every arm walks every combination; or a design"});
    a.Field("first_seed", first_seed, {.doc = "master seed of the first episode"});
    a.Field("seeds", seeds, {.min = 1, .max = 100000, .doc = "episodes per arm and combination"});
    a.Field("stop", stop, {.doc = "ends the campaign before its seeds are spent"});
    a.Field("expect", expect,
            {.doc = "what scoria check holds the episodes of each arm together to, by the names of "
                    "a scenario's expect; that holds for every episode"});
  }
};

}  // namespace scoria::app
