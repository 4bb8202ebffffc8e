// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/config_kinds.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <yaml-cpp/yaml.h>

#include "app/campaign/campaign.h"
#include "app/scenario/config_docs.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// YAML as the JSON that an editor's checker sees.
nlohmann::json ToJson(const YAML::Node& yaml) {
  nlohmann::json json;
  if (yaml.IsMap()) {
    json = nlohmann::json::object();
    for (const auto& pair : yaml) json[pair.first.Scalar()] = ToJson(pair.second);
  } else if (yaml.IsSequence()) {
    json = nlohmann::json::array();
    for (const YAML::Node& item : yaml) json.push_back(ToJson(item));
  } else if (yaml.IsScalar()) {
    const bool is_plain = yaml.Tag() == "?";
    bool truth = false;
    double number = 0.0;
    if (is_plain && YAML::convert<bool>::decode(yaml, truth)) {
      json = truth;
    } else if (is_plain && YAML::convert<double>::decode(yaml, number)) {
      const bool is_whole = std::abs(number) < 1e15 && number == std::floor(number);
      json = is_whole ? nlohmann::json(static_cast<std::int64_t>(number)) : nlohmann::json(number);
    } else {
      json = yaml.Scalar();
    }
  }
  return json;
}

/// The schema of a kind, as an editor would use it.
class Checker {
 public:
  explicit Checker(std::string_view kind) : json_(nlohmann::json::parse(ConfigJsonSchema(kind))) {
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(json_), schema_);
  }

  /// What is wrong with the YAML, empty if nothing.
  [[nodiscard]] std::string Problem(const YAML::Node& yaml) const {
    valijson::Validator validator;
    valijson::ValidationResults results;
    const nlohmann::json json = ToJson(yaml);
    if (validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(json), &results))
      return "";
    std::string text = "refused";
    for (valijson::ValidationResults::Error error; results.popError(error);)
      text += fmt::format("; {}: {}", fmt::join(error.context, ""), error.description);
    return text;
  }

 private:
  nlohmann::json json_;
  valijson::Schema schema_;
};

/// The kind of a YAML file of the repository, by the folder that it lies in.
std::string KindOfFolder(const fs::path& file) {
  const std::string folder = file.parent_path().lexically_relative(test::SourcePath("")).string();
  if (folder == "robots/payloads") return "payload";
  if (folder == "scenarios/controllers") return "controller";
  if (folder == "scenarios/operators") return "operator";
  const std::map<std::string, std::string> tops = {
      {"robots", "robot"},       {"terrains", "terrain"}, {"scenarios", "scenario"},
      {"campaigns", "campaign"}, {"mappings", "mapping"}, {"tests", "robot"}};
  return tops.at(folder.substr(0, folder.find('/')));
}

std::vector<fs::path> ShippedFiles() {
  std::vector<fs::path> files;
  for (const char* folder :
       {"robots", "terrains", "scenarios", "campaigns", "mappings", "tests/data/robots"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::SourcePath(folder))) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
  }
  return files;
}

TEST(Schema, EveryFileOfTheRepositoryKeepsToIt) {
  std::map<std::string, int> checked;
  std::map<std::string, Checker> checkers;
  for (const fs::path& file : ShippedFiles()) {
    const std::string kind = KindOfFolder(file);
    const Checker& checker = checkers.try_emplace(kind, kind).first->second;
    EXPECT_EQ(checker.Problem(YAML::LoadFile(file.string())), "") << file;
    ++checked[kind];
  }
  for (const ConfigKind& kind : ConfigKinds())
    EXPECT_GT(checked[std::string(kind.name)], 0) << kind.name;
}

// A misspelt key, at the top and inside, is caught by every schema.
TEST(Schema, UnknownKeysAndWrongValuesAreCaught) {
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {"scenario", "{name: x, terain: {}}"},
      {"scenario", "{name: x, duration_s: long}"},
      {"scenario", "{name: x, controller: {mpc: {horizon: 40}}}"},
      {"scenario", "{name: x, controller: {gait: {type: trott}}}"},
      {"scenario", "{name: x, pushes: [{at_s: 1, impuls_Ns: 3}]}"},
      {"campaign", "{name: x, arm: []}"},
      {"campaign", "{name: x, arms: [{name: a, set: {controler: {}}}]}"},
      {"campaign", "{name: x, sweep: [{key: seed, value: [1]}]}"},
      {"robot", "{name: x, legs: {FL: {haa: a, foott: b}}}"},
      {"robot", "{name: x, motors: {idle_W: -1}}"},
      {"terrain", "{name: x, rocks: {area_fractoin: 0.1}}"},
      {"payload", "{name: x, mass: 3}"},
      {"controller", "{gait: {type: ags, low: {}}}"},
      {"operator", "{type: route, sped_mps: 1}"},
      {"mapping", "{joints: {q: position, qq: velocity}}"},
      {"mapping", "{joints: {q: {field: position, unit: degrees}}}"},
      {"mapping", "{topics: {state: {typ: a/msg/B}}}"},
  };
  for (const auto& [kind, yaml] : wrong)
    EXPECT_NE(Checker(kind).Problem(YAML::Load(yaml)), "") << kind << ": " << yaml;
}

/// What reading `yaml` as a file of that kind says, without the folder.
std::string ErrorOf(std::string_view kind, const std::string& yaml) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "a.yaml";
  core::WriteText(file, yaml);
  try {
    (void)LoadKind(kind, file, {});
  } catch (const core::ConfigError& e) {
    const std::string text = e.what(), prefix = folder.path().string() + "/";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  }
  return "no error";
}

TEST(ConfigKinds, AFileOfAnotherKindIsNamed) {
  const std::string robot = core::ReadText(test::SourcePath("robots/go2/go2.yaml"));
  EXPECT_EQ(ErrorOf("scenario", robot),
            "a.yaml: is a robot, not a scenario (for scoria info, robot: of a scenario)");
  EXPECT_EQ(ErrorOf("terrain", "name: x\nscenario: {}\narms: []\n"),
            "a.yaml: is a campaign, not a terrain (for scoria campaign)");
  EXPECT_EQ(ErrorOf("campaign", "name: x\nrobot: {}\nduration_s: 3\n"),
            "a.yaml: is a scenario, not a campaign (for scoria run)");
  EXPECT_EQ(ErrorOf("robot", "name: x\nsize_m: 20\nrocks: {}\n"),
            "a.yaml: is a terrain, not a robot (for scoria terrain, terrain: of a scenario)");
  EXPECT_EQ(ErrorOf("robot", "name: x\nmass_kg: 2\n"),
            "a.yaml: is a payload, not a robot (for payloads: of a scenario)");
  EXPECT_EQ(ErrorOf("robot", robot), "no error");
  EXPECT_EQ(ErrorOf("robot", "name: x\n"), "no error");                 // what lacks says so later
  EXPECT_EQ(ErrorOf("scenario", "name: x\nrobbot: {}\n"), "no error");  // a slip: did you mean
}

std::string CampaignError(const std::string& yaml) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "c.yaml";
  core::WriteText(file, yaml);
  try {
    (void)LoadCampaign(file, {});
  } catch (const core::ConfigError& e) {
    const std::string what = e.what();
    return what.substr(what.find("c.yaml"));
  }
  return "no error";
}

TEST(Campaign, MisspeltKeysNameTheirNeighbours) {
  const std::string scenario =
      fmt::format("scenario: {{base: {}}}\n", test::SourcePath("scenarios/flat.yaml").string());
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arm: [{name: a}]\n"),
            "c.yaml:1:1: arms: is missing and has no default");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: [{name: a}]\nseed: 2\n"),
            "c.yaml:4:1: seed: unknown key (did you mean \"seeds\"?)");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: [{nam: a}]\n"),
            "c.yaml:3:8: arms[0].name: is missing and has no default");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: [{name: a, sets: {}}]\n"),
            "c.yaml:3:18: arms[0].sets: unknown key (did you mean \"set\"?)");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: [{name: a, set: 3}]\n"),
            "c.yaml:3:23: arms[0].set: \"3\" is not a map");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: {name: a}\n"),
            "c.yaml:3:7: arms: a map is not a list");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: []\n"),
            "c.yaml:3:7: arms: must list at least one arm");
  EXPECT_EQ(CampaignError("name: c\n" + scenario + "arms: [{name: a, set: {controler: {}}}]\n"),
            "c.yaml:3:24: controler: unknown key (did you mean \"controller\"?)");
}

}  // namespace
}  // namespace scoria::app
