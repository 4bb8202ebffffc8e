// SPDX-License-Identifier: BSD-3-Clause
// What a mapping file may say, and what is said of one that is wrong.
#include <fstream>

#include <gtest/gtest.h>

#include "logs/format/open_log.h"
#include "logs/mapping/choose_mapping.h"
#include "logs/mapping/field_pattern.h"
#include "logs/mapping/mapped_rows.h"
#include "tests/support/memory_log.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

/// What reading a mapping, or one of a log by it, says.
std::string ErrorOf(const std::string& yaml, LogSource* log = nullptr) {
  try {
    const Mapping mapping = ParseMapping(yaml, "m.yaml");
    if (log != nullptr) ForEachMappedRow(*log, mapping, TypeResolver(), [](const Row&) {});
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

Texts PathsOf(const ExpandedPattern& pattern) {
  Texts paths;
  for (const PatternPlace& place : pattern.places)
    paths.push_back(place.path + (pattern.elements > 1 ? "#" + std::to_string(place.element) : ""));
  return paths;
}

const PatternNames kNames = {{"FR", "FL", "RR", "RL"}, {"hip", "thigh", "calf"}};

TEST(FieldPattern, StandsForAllNumbersOfASignal) {
  const auto paths = [](const char* pattern, SignalShape shape) {
    return PathsOf(ExpandPattern(pattern, shape, SizeOf(shape), kNames));
  };
  EXPECT_EQ(paths("v{axis}", SignalShape::kVector), (Texts{"vx", "vy", "vz"}));
  EXPECT_EQ(paths("data[{i+7}]", SignalShape::kVector), (Texts{"data[7]", "data[8]", "data[9]"}));
  EXPECT_EQ(paths("position", SignalShape::kVector),
            (Texts{"position#0", "position#1", "position#2"}));
  EXPECT_EQ(paths("foot_{leg}", SignalShape::kPerLeg),
            (Texts{"foot_FR", "foot_FL", "foot_RR", "foot_RL"}));
  const Texts joints = paths("{leg}_{joint}.q", SignalShape::kPerJoint);
  ASSERT_EQ(joints.size(), 12u);
  EXPECT_EQ(joints[1], "FR_thigh.q");
  EXPECT_EQ(joints[11], "RL_calf.q");
  EXPECT_EQ(paths("{leg}.q", SignalShape::kPerJoint)[4], "FL.q#1");
  EXPECT_EQ(paths("{leg}.q[{i}]", SignalShape::kPerJoint)[4], "FL.q[1]");
  EXPECT_EQ(paths("m[{i}].q", SignalShape::kPerJoint)[4], "m[4].q");
  EXPECT_EQ(paths("feet[{i}].{axis}", SignalShape::kVectorPerLeg)[4], "feet[1].y");
  EXPECT_EQ(paths("F{axis}_{leg}", SignalShape::kVectorPerLeg)[4], "Fy_FL");
  EXPECT_EQ(paths("voltage", SignalShape::kScalar), Texts{"voltage"});
  PatternNames by_joint = kNames;
  by_joint.by_joint = true;
  EXPECT_EQ(PathsOf(ExpandPattern("{leg}_{joint}", SignalShape::kPerJoint, 12, by_joint))[1],
            "FL_hip");
}

std::string PatternErrorOf(const char* pattern, SignalShape shape) {
  try {
    (void)ExpandPattern(pattern, shape, SizeOf(shape), kNames);
  } catch (const PatternError& e) {
    return e.what();
  }
  return "";
}

TEST(FieldPattern, SaysWhichPlaceholdersThereAre) {
  EXPECT_EQ(PatternErrorOf("v{leg}", SignalShape::kVector),
            "{leg} is no placeholder here; choices: {axis}, {i}");
  EXPECT_EQ(PatternErrorOf("q{i-1}", SignalShape::kPerJoint),
            "{i-1} is no placeholder here; choices: {leg}, {joint}, {i}");
  EXPECT_EQ(PatternErrorOf("q{i", SignalShape::kPerJoint), "a { has no }");
}

TEST(MappingFile, WrongKeysUnitsAndChoicesAreNamed) {
  EXPECT_EQ(ErrorOf("joints: {q: position, qq: velocity}\n"),
            "m.yaml:1:23: joints.qq: unknown key (did you mean \"q\"?)");
  EXPECT_EQ(
      ErrorOf("joints: {q: {field: position, unit: degr}}\n"),
      "m.yaml:1:37: joints.q.unit: unknown \"degr\"; choices: deg, rad (did you mean \"deg\"?)");
  EXPECT_EQ(ErrorOf("truth:\n  position: {field: p, unit: rad}\n"),
            "m.yaml:2:30: truth.position.unit: unknown \"rad\"; choices: cm, m, mm");
  EXPECT_EQ(
      ErrorOf("estimate:\n  velocity: {field: v, frame: wrold}\n"),
      "m.yaml:2:31: estimate.velocity.frame: unknown \"wrold\"; choices: body, world (did you "
      "mean \"world\"?)");
  EXPECT_EQ(ErrorOf("joints: {q: {unit: deg}}\n"),
            "m.yaml:1:13: joints.q: needs either field or fields");
  EXPECT_EQ(ErrorOf("plan: {period: T, duty: d, phase: p}\n"),
            "m.yaml:1:7: plan.stance: is missing and has no default");
  EXPECT_EQ(ErrorOf("name: empty\n"), "m.yaml:1:1: maps no signal");
}

TEST(MappingFile, LegsAndAxesAreChecked) {
  EXPECT_EQ(
      ErrorOf("legs: [FR, FL, RR, leg3]\njoints: {q: q}\n"),
      "m.yaml:1:7: legs: \"leg3\" is no leg; FL, FR, HL, HR are, as LF, RR, br or front_left: "
      "what else the log calls them stands in leg_names");
  EXPECT_EQ(ErrorOf("legs: [FR, FL, RR, HR]\njoints: {q: q}\n"),
            "m.yaml:1:7: legs: \"HR\" is a leg that is named before");
  EXPECT_EQ(ErrorOf("imu: {rate: {field: w, axes: [x, y, up]}}\n"),
            "m.yaml:1:30: imu.rate.axes: \"up\" is none of x, y, z, -x, -y, -z");
  EXPECT_EQ(ErrorOf("imu: {rate: {field: w, axes: [x, -x, z]}}\n"),
            "m.yaml:1:30: imu.rate.axes: names an axis twice");
  EXPECT_EQ(ErrorOf("truth: {position: [x, y]}\n"),
            "m.yaml:1:19: truth.position.fields: has 2 fields, not 3");
}

/// A CSV file with four joints' worth of columns less than a robot has.
class CsvFile {
 public:
  explicit CsvFile(const std::string& text, const std::string& name = "walk.csv")
      : path_(folder_.path() / name) {
    std::ofstream(path_) << text;
    log_ = OpenLog(path_);
  }
  [[nodiscard]] LogSource* log() const { return log_.get(); }

 private:
  test::TemporaryFolder folder_;
  fs::path path_;
  std::unique_ptr<LogSource> log_;
};

TEST(MappingFile, ColumnsThatAreNotThereAreNamed) {
  const CsvFile csv("t,acc_x,acc_y,acc_z\n0,0,0,9.8\n0.1,0,0,9.8\n");
  EXPECT_EQ(ErrorOf("imu: {acceleration: 'acc_{axis}'}\n", csv.log()), "");
  EXPECT_EQ(ErrorOf("imu: {acceleration: 'ac_{axis}'}\n", csv.log()),
            "m.yaml:1:21: imu.acceleration: walk: there is no column \"ac_x\" (did you mean "
            "\"acc_x\"?)");
  EXPECT_EQ(ErrorOf("imu: {acceleration: '{i+2}'}\n", csv.log()),
            "m.yaml:1:21: imu.acceleration: walk: 4: there are 4 columns, counted from 0");
  EXPECT_EQ(
      ErrorOf("imu: {acceleration: 'acc_{leg}'}\n", csv.log()),
      "m.yaml:1:21: imu.acceleration: walk: {leg} is no placeholder here; choices: {axis}, {i}");
  EXPECT_EQ(ErrorOf("imu: {topic: wlk, acceleration: 'acc_{axis}'}\n", csv.log()),
            "m.yaml:1:14: imu.topic: the log has no topic \"wlk\" (did you mean \"walk\"?)");
  EXPECT_EQ(ErrorOf("topics: {i: {columns: 12}}\nimu: {acceleration: 'acc_{axis}'}\n", csv.log()),
            "m.yaml:1:13: topics.i: the log has no CSV file of 12 columns");
  EXPECT_EQ(ErrorOf("topics: {i: {names: [wolk]}}\nimu: {acceleration: 'acc_{axis}'}\n", csv.log()),
            "m.yaml:1:13: topics.i: the log has no topic wolk (did you mean \"walk\"?)");
  EXPECT_EQ(
      ErrorOf("base_topic: fast\nimu: {topic: walk, acceleration: 'acc_{axis}'}\n", csv.log()),
      "m.yaml:1:13: base_topic: \"fast\" is no topic of this mapping");
}

TEST(MappingFile, ClocksThatAreNotThereAreNamed) {
  const CsvFile csv("n,acc_x,acc_y,acc_z\n4,0,0,9.8\n5,0,0,9.8\n6,0,0,9.8\n");
  const std::string imu = "imu: {acceleration: 'acc_{axis}'}\n";
  EXPECT_EQ(ErrorOf(imu, csv.log()),
            "m.yaml:1:1: time: walk: no column grows as time does; time.stamp names one, or "
            "time.row_period_s is the time from row to row");
  EXPECT_EQ(ErrorOf("time: {row_period_s: 0.01}\n" + imu, csv.log()), "");
  EXPECT_EQ(ErrorOf("time: {stamp: n}\n" + imu, csv.log()), "");
  EXPECT_EQ(ErrorOf("time: {stamp: m}\n" + imu, csv.log()),
            "m.yaml:1:15: time.stamp: no topic has times in \"m\"");
  EXPECT_EQ(ErrorOf("time: {counter: m}\n" + imu, csv.log()),
            "m.yaml:1:17: time.counter: no topic has counts in \"m\"");
  EXPECT_EQ(ErrorOf("time: {clock: header, row_period_s: 1}\n" + imu, csv.log()),
            "m.yaml:1:15: time.clock: walk has no header stamps");
}

/// A log of the robot of docs/mappings.md.
test::MemoryLog MyRobot() {
  test::MemoryLog log;
  const std::size_t state =
      log.AddChannel("/state", "my_robot/msg/State",
                     "Motor[12] motor\nfloat64[12] torque\n================================\n"
                     "MSG: my_robot/Motor\nfloat64 angle\nfloat64 rpm\n");
  (void)log.AddChannel("/imu", "sensor_msgs/msg/Imu");
  Bytes message(4 + 36 * 8);
  message[1] = std::byte{1};
  for (int i = 0; i < 3; ++i) log.Add(state, i * 1'000'000, message);
  return log;
}

std::string PageText() {
  std::ifstream in(test::SourcePath("docs/mappings.md"));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The blocks of YAML on the page.
Texts Examples(const std::string& page) {
  Texts examples;
  const std::string open = "```yaml\n";
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const std::size_t from = at + open.size();
    examples.push_back(page.substr(from, page.find("```", from) - from));
  }
  return examples;
}

TEST(MappingsPage, ExamplesAreMappingsThatWork) {
  const Texts examples = Examples(PageText());
  ASSERT_EQ(examples.size(), 2u);
  std::string header = "time", row;
  for (const char* what : {"pos", "vel"}) {
    for (const char* leg : {"LF", "RF", "LH", "RH"}) {
      for (const char* joint : {"HAA", "HFE", "KFE"})
        header += std::string(",") + leg + "_" + joint + "_" + what;
    }
  }
  for (int i = 0; i < 24 + 6; ++i) row += ",1";
  const CsvFile csv(header + ",ax,ay,az,gx,gy,gz\n0" + row + "\n1" + row + "\n");
  EXPECT_EQ(ErrorOf(examples[0], csv.log()), "");
  test::MemoryLog log = MyRobot();
  EXPECT_EQ(ErrorOf(examples[1], &log), "");
}

TEST(MappingsPage, ShowsWhatIsSaidOfWrongMappings) {
  const std::string page = PageText();
  test::MemoryLog log = MyRobot();
  for (const char* yaml : {"joints:\n  topic: /state\n  q: motr[{i}].angle\n",
                           "joints:\n  topic: /state\n  q: motor[{i}].angle\n  qd: {field: "
                           "\"motor[{i}].rpm\", unit: degs}\n",
                           "topics:\n  state: {type: my_robot/msg/Stat}\njoints: {q: motor}\n"}) {
    const std::string error = ErrorOf(yaml, &log);
    EXPECT_NE(page.find(error), std::string::npos) << error;
    EXPECT_NE(error, "");
  }
}

TEST(ChooseMapping, SaysWhenNoneOrTwoFit) {
  const CsvFile csv("t,acc_x,acc_y,acc_z\n0,0,0,9.8\n0.1,0,0,9.8\n");
  const auto choose = [&](const std::vector<Mapping>& mappings) -> std::string {
    try {
      return ChooseMapping(csv.log()->contents(), mappings).name();
    } catch (const MappingChoiceError& e) {
      return std::string(e.what()).substr(csv.log()->contents().path.string().size());
    }
  };
  const Mapping one = ParseMapping("imu: {acceleration: 'acc_{axis}'}\n", "one.yaml"),
                two = ParseMapping("imu: {acceleration: [acc_x, acc_y, acc_z]}\n", "two.yaml"),
                other = ParseMapping("imu: {rate: 'gyro_{axis}'}\n", "other.yaml");
  EXPECT_EQ(choose({one, other}), "one");
  EXPECT_EQ(choose({one, two}), ": the mappings one and two fit equally; say which");
  EXPECT_EQ(choose({other}),
            ": none of the mappings other fits its topics, types and columns; write one "
            "(docs/mappings.md) or draft one: scoria info LOG --draft-mapping FILE");
}

TEST(FindMapping, IsByNameOrFile) {
  EXPECT_EQ(FindMapping("unitree_go2").name(), "unitree_go2");
  EXPECT_EQ(FindMapping(test::SourcePath("mappings/unitree_go2.yaml").string()).name(),
            "unitree_go2");
  EXPECT_GE(ShippedMappings().size(), 11u);
  try {
    (void)FindMapping("unitree_go3");
    FAIL();
  } catch (const core::ConfigError& e) {
    EXPECT_STREQ(
        e.what(),
        "unitree_go3: is neither a file nor a shipped mapping (did you mean \"unitree_go2\"?)");
  }
}

/// Every file of the folder is built in: one that is forgotten would be found by nobody.
TEST(FindMapping, AllOfTheFolderAreShipped) {
  Texts files, names;
  for (const auto& entry : fs::directory_iterator(test::SourcePath("mappings")))
    files.push_back(entry.path().stem().string());
  for (const Mapping& mapping : ShippedMappings()) {
    names.push_back(mapping.name());
    const fs::path& robot = mapping.file().robot;
    EXPECT_TRUE(robot.empty() || fs::exists(test::SourcePath(robot.string()))) << robot;
  }
  std::sort(files.begin(), files.end());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(files, names);
}

}  // namespace
}  // namespace scoria::logs
