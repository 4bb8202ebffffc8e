// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

enum class Colour { kRed, kGreen };
constexpr std::array<std::pair<Colour, std::string_view>, 2> EnumNames(Colour) {
  return {{{Colour::kRed, "red"}, {Colour::kGreen, "green"}}};
}

struct Circle {
  static constexpr const char* kType = "circle";
  double radius_m = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("radius_m", radius_m, {.min = 0.1, .max = 2.0});
  }
  bool operator==(const Circle&) const = default;
};

struct Square {
  static constexpr const char* kType = "square";
  double edge_m = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("edge_m", edge_m);
  }
  bool operator==(const Square&) const = default;
};

struct Sample {
  std::string name;
  int count = 3;
  bool on = false;
  Colour colour = Colour::kRed;
  Vec3 p = Vec3::Zero();
  std::variant<Circle, Square> shape;
  std::vector<Circle> list;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Field("count", count, {.min = 1, .max = 9});
    a.Field("on", on);
    a.Field("colour", colour);
    a.Field("p", p);
    a.Field("shape", shape);
    a.Field("list", list);
  }
  bool operator==(const Sample&) const = default;
};

std::string ErrorOf(const std::string& yaml) {
  try {
    (void)ReadConfig<Sample>(ParseConfig(yaml, "a.yaml"));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Config, ErrorsNamePlaceKeyValueAndRule) {
  EXPECT_EQ(ErrorOf("count: 3\n"), "a.yaml:1:1: name: is missing and has no default");
  EXPECT_EQ(ErrorOf("name: x\ncount: 12\n"), "a.yaml:2:8: count: 12 is outside [1, 9]");
  EXPECT_EQ(ErrorOf("name: x\ncount: 2.5\n"), "a.yaml:2:8: count: \"2.5\" is not a whole number");
  EXPECT_EQ(ErrorOf("name: x\ncuont: 2\n"),
            "a.yaml:2:1: cuont: unknown key (did you mean \"count\"?)");
  EXPECT_EQ(ErrorOf("name: x\nzebra: 2\n"),
            "a.yaml:2:1: zebra: unknown key; known here: name, count, on, colour, p, shape, list");
  EXPECT_EQ(ErrorOf("name: x\nname: y\n"), "a.yaml:2:1: name: given twice, first in line 1");
  EXPECT_EQ(ErrorOf("name: x\non: yes\n"), "a.yaml:2:5: on: \"yes\" is not true or false");
  EXPECT_EQ(ErrorOf("name: x\ncolour: gren\n"),
            "a.yaml:2:9: colour: unknown \"gren\"; choices: green, red (did you mean \"green\"?)");
  EXPECT_EQ(ErrorOf("name: x\np: [1, 2]\n"), "a.yaml:2:4: p: has 2 elements, must have 3");
  EXPECT_EQ(ErrorOf("name: x\nshape: {type: circel}\n"),
            "a.yaml:2:15: shape.type: unknown \"circel\"; choices: circle, square (did you mean "
            "\"circle\"?)");
  EXPECT_EQ(ErrorOf("name: x\nshape: {type: circle, radius_m: 5}\n"),
            "a.yaml:2:33: shape.radius_m: 5 is outside [0.1, 2]");
  EXPECT_EQ(ErrorOf("name: x\nlist: [{radius_m: a}]\n"),
            "a.yaml:2:19: list[0].radius_m: \"a\" is not a number");
  EXPECT_EQ(ErrorOf("name: x\nlist: 3\n"), "a.yaml:2:7: list: \"3\" is not a list");
  EXPECT_EQ(ErrorOf("name: [\n").substr(0, 30), "a.yaml:2:1: not valid YAML: en");
  // yaml-cpp's LoadAll does not return from the first of these.
  EXPECT_EQ(ErrorOf(",n"), "a.yaml:1:1: not valid YAML: a value does not begin with ,");
  EXPECT_EQ(ErrorOf("# ü\n]"), "a.yaml:2:1: not valid YAML: illegal flow end");
  EXPECT_EQ(ErrorOf("name: x\n---\nname: y\n"), "a.yaml: holds more than one YAML document");
  EXPECT_EQ(ErrorOf("name: x\n...\n,"), "a.yaml: holds more than one YAML document");
}

struct SquareByDefault {
  std::variant<Circle, Square> shape = Square{};
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("shape", shape);
  }
};

TEST(Config, VariantWithoutTypeKeepsItsDefaultsType) {
  const auto read = ReadConfig<SquareByDefault>(ParseConfig("shape: {edge_m: 1.5}\n", "c.yaml"));
  EXPECT_EQ(std::get<Square>(read.shape).edge_m, 1.5);
}

enum class Surface { kRough };
constexpr std::array<std::pair<Surface, std::string_view>, 1> EnumNames(Surface) {
  return {{{Surface::kRough, "rough"}}};
}
constexpr std::array<std::pair<Surface, std::string_view>, 1> FormerNames(Surface) {
  return {{{Surface::kRough, "bumpy"}}};
}

struct Disc {
  static constexpr const char* kType = "disc";
  static constexpr const char* kFormerType = "plate";
  double radius_m = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("radius_m", radius_m,
            {.min = 0.1, .max = 2.0, .was = "diameter_m", .from_was = [](double diameter_m) {
               return 0.5 * diameter_m;
             }});
  }
};

struct Renamed {
  int count = 0;
  Surface surface = Surface::kRough;
  std::variant<Square, Disc> shape;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("count", count, {.max = 9, .was = "number"});
    a.Field("surface", surface);
    a.Field("shape", shape);
  }
};

TEST(Config, FormerNamesAreReadWithANote) {
  ConfigContext context;
  const auto read = ReadConfig<Renamed>(
      ParseConfig("number: 4\nsurface: bumpy\nshape: {type: plate, diameter_m: 3}\n", "d.yaml"),
      context);
  EXPECT_EQ(read.count, 4);
  EXPECT_EQ(std::get<Disc>(read.shape).radius_m, 1.5);
  EXPECT_EQ(
      context.notes,
      (ConfigNotes{"d.yaml:1:9: number is now count", "d.yaml:2:10: surface: bumpy is now rough",
                   "d.yaml:3:15: shape.type: plate is now disc",
                   "d.yaml:3:34: shape.diameter_m is now radius_m, here 1.5"}));
  const auto error_of = [](const char* yaml) -> std::string {
    try {
      (void)ReadConfig<Renamed>(ParseConfig(yaml, "d.yaml"));
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("number: 12\n"), "d.yaml:1:9: number: 12 is outside [-.inf, 9]");
  EXPECT_EQ(error_of("number: 4\ncount: 4\n"),
            "d.yaml:1:9: count: is given as number, its former name, too");
  EXPECT_EQ(error_of("nummer: 4\n"), "d.yaml:1:1: count: is missing and has no default");
}

TEST(Config, WrittenConfigReadsBackEqual) {
  Sample sample;
  sample.name = "a: \"quoted\" name # with signs";
  sample.count = 7;
  sample.on = true;
  sample.colour = Colour::kGreen;
  sample.p = {0.1, -1e-9, 3.0};
  sample.shape = Square{2.5};
  sample.list = {{0.3}, {1.7}};
  const std::string yaml = EmitYaml(WriteConfig(sample));
  EXPECT_EQ(ReadConfig<Sample>(ParseConfig(yaml, "b.yaml")), sample) << yaml;
}

TEST(Config, BaseIsOverriddenDeeplyAndErrorsPointIntoIt) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "base.yaml")
      << "name: base\nshape: {type: circle, radius_m: 0.5}\ncount: 99\n";
  std::ofstream(folder.path() / "child.yaml")
      << "base: base.yaml\nshape: {radius_m: 0.7}\ncount: 4\n";
  std::ofstream(folder.path() / "bad.yaml") << "base: base.yaml\nname: x\n";
  const auto child = ReadConfig<Sample>(LoadConfig(folder.path() / "child.yaml"));
  EXPECT_EQ(child.name, "base");
  EXPECT_EQ(std::get<Circle>(child.shape).radius_m, 0.7);
  try {
    (void)ReadConfig<Sample>(LoadConfig(folder.path() / "bad.yaml"));
    FAIL() << "99 is out of range";
  } catch (const ConfigError& e) {
    EXPECT_EQ(std::string(e.what()),
              (folder.path() / "base.yaml").string() + ":3:8: count: 99 is outside [1, 9]");
  }
}

TEST(Config, BaseThatIncludesItselfIsRefused) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.yaml") << "base: b.yaml\n";
  std::ofstream(folder.path() / "b.yaml") << "base: a.yaml\n";
  EXPECT_THROW((void)LoadConfig(folder.path() / "a.yaml"), ConfigError);
}

/// What reading `content` as a YAML file says, without the folder.
std::string FileErrorOf(const std::string& content) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.yaml";
  std::ofstream(file, std::ios::binary) << content;
  try {
    (void)ReadConfig<Sample>(LoadConfig(file));
  } catch (const ConfigError& e) {
    const std::string text = e.what(), prefix = folder.path().string() + "/";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  }
  return "no error";
}

TEST(Config, AFileOfAnotherKindIsNamedInOneLine) {
  using namespace std::string_literals;
  EXPECT_EQ(FileErrorOf("<robot name=\"r\">\n" + std::string(100000, ' ')),
            "a.yaml: is a URDF, not a YAML file (a robot's YAML names it: urdf: NAME.urdf)");
  EXPECT_EQ(FileErrorOf("<robot name=\"r\"><mass value=\"${m}\"/>"),
            "a.yaml: is a xacro, not a YAML file (expand it: xacro IN > OUT.urdf)");
  EXPECT_EQ(FileErrorOf("ncols 16\nnrows 16\n" + std::string(100000, '1')),
            "a.yaml: is an ESRI ASCII grid, not a YAML file (a terrain names it: heightmap: {file: "
            "NAME.asc})");
  EXPECT_EQ(FileErrorOf("\x89MCAP0\r\n"),
            "a.yaml: is an MCAP log, not a YAML file (render, replay and verify take it)");
  EXPECT_EQ(FileErrorOf("a\0b"s), "a.yaml: is a binary file, not a YAML file");
  EXPECT_EQ(FileErrorOf(std::string(20000000, '\n')),
            "a.yaml: has 19 MiB; a YAML file of scoria has at most 16");
  EXPECT_EQ(FileErrorOf("time_s,x_m\n0,1\n"), "a.yaml:1:1: \"time_s,x_m 0,1\" is not a map");
  const std::string folder = std::filesystem::temp_directory_path().string();
  try {
    (void)LoadConfig(folder);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_TRUE(std::string(e.what()).ends_with(" is a folder, not a YAML file")) << e.what();
  }
}

TEST(Config, TextThatIsNotUtf8IsRefusedWithItsPlace) {
  EXPECT_EQ(FileErrorOf("count: 3\nname: R\xfc"
                        "ckweg\n"),
            "a.yaml:2:8: name: byte 0xFC is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(FileErrorOf("name: x  # Gr\xf6\xdf"
                        "e\n"),
            "a.yaml:1:14: byte 0xF6 is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(FileErrorOf("{count: 3, name: \xe9}\n"),
            "a.yaml:1:18: name: byte 0xE9 is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(FileErrorOf("name: R\xc3\xbc"
                        "ckweg\n"),
            "no error");
  ConfigNode node = ParseConfig("name: x\n", "a.yaml");
  try {
    ApplyOverride(node,
                  "name=R\xfc"
                  "ckweg");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(),
                 "--set name=R\\xFCckweg: byte 0xFC is not UTF-8; save the file as UTF-8");
  }
}

TEST(Config, LongValuesAndKeysAreShortened) {
  const std::string many(100000, '7');
  EXPECT_EQ(ErrorOf("name: x\ncount: x" + many + "\n"), "a.yaml:2:8: count: \"x" +
                                                            many.substr(0, 59) +
                                                            "... (100001 bytes)\" is not a whole "
                                                            "number");
  for (const std::string& yaml :
       {"name: x\nlist: " + many, "name: x\nk" + many + ": 1", "name: x\ncolour: " + many,
        "name: x\nshape: {type: " + many + "}", "name: [" + many, "name: x\nname: y" + many,
        "name: x\non: 'a\n\n" + many + "'"}) {
    const std::string error = ErrorOf(yaml);
    EXPECT_NE(error, "no error");
    EXPECT_LT(error.size(), 400u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(Config, AliasesThatMultiplyAreRefused) {
  std::string yaml = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    yaml += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i,
                        i - 1);
  }
  const std::string error = ErrorOf(yaml);
  EXPECT_TRUE(error.ends_with(": has more than 1000000 values, aliases included")) << error;
}

TEST(Config, MergeKeysLayMapsUnderOthers) {
  const auto read = [](const std::string& yaml) {
    return ReadConfig<Sample>(ParseConfig(yaml, "a.yaml"));
  };
  const Sample one = read("name: x\nshape: &s {type: square, edge_m: 2}\nlist: []\n");
  EXPECT_EQ(read("name: x\nshape: {<<: {type: square, edge_m: 2}}\n").shape, one.shape);
  EXPECT_EQ(read("name: x\nlist: [&a {radius_m: 0.5}, {<<: *a}, {<<: *a, radius_m: 0.7}]\n").list,
            (std::vector<Circle>{{0.5}, {0.5}, {0.7}}));
  // Of several maps the first counts.
  EXPECT_EQ(read("name: x\nlist: [&a {radius_m: 0.5}, &b {radius_m: 0.6}, {<<: [*b, *a]}]\n").list,
            (std::vector<Circle>{{0.5}, {0.6}, {0.6}}));
  EXPECT_EQ(ErrorOf("name: x\nshape: {<<: other.yaml}\n"),
            "a.yaml:2:13: <<: merges maps of this file, as <<: *anchor; use base: for a file");
  EXPECT_EQ(ErrorOf("name: x\nlist: [&a {radius: 0.5}]\n").substr(0, 12), "a.yaml:2:12:");
}

TEST(Config, OverrideSetsNestedKeysAndNewVariantsReplaceOldOnes) {
  ConfigNode node = ParseConfig("name: x\nshape: {type: circle, radius_m: 0.5}\n", "a.yaml");
  ApplyOverride(node, "shape.radius_m=0.9");
  EXPECT_EQ(std::get<Circle>(ReadConfig<Sample>(node).shape).radius_m, 0.9);
  ApplyOverride(node, "shape.type=square");  // the circle's radius means nothing to a square
  EXPECT_EQ(std::get<Square>(ReadConfig<Sample>(node).shape).edge_m, 1.0);
  EXPECT_THROW(ApplyOverride(node, "nonsense"), ConfigError);
}

TEST(Config, DescriptionListsRangesDefaultsAndAlternatives) {
  const FieldInfo info = DescribeConfig<Sample>();
  ASSERT_EQ(info.children.size(), 7u);
  EXPECT_TRUE(info.children[0].required);
  EXPECT_EQ(info.children[1].default_value, "3");
  EXPECT_EQ(info.children[1].max, 9.0);
  EXPECT_EQ(info.children[5].children.size(), 2u);
}

}  // namespace
}  // namespace scoria::core
