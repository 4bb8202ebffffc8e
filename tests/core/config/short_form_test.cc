// SPDX-License-Identifier: BSD-3-Clause
// Maps by name, and structs that may be written as one value.
#include <gtest/gtest.h>

#include "core/config/archive.h"

namespace scoria::core {
namespace {

struct Place {
  static constexpr const char* kScalarKey = "field";
  static constexpr const char* kListKey = "fields";
  std::string field;
  std::vector<std::string> fields;
  double scale = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("field", field);
    a.Field("fields", fields);
    a.Field("scale", scale, {.min = 0.0});
  }
  bool operator==(const Place&) const = default;
};

struct Places {
  std::map<std::string, Place> places;
  std::array<std::string, 2> names = {"a", "b"};
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("places", places);
    a.Field("names", names);
  }
  bool operator==(const Places&) const = default;
};

Places Read(const std::string& yaml) { return ReadConfig<Places>(ParseConfig(yaml, "a.yaml")); }

std::string ShortFormErrorOf(const std::string& yaml) {
  try {
    (void)Read(yaml);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ShortForm, OneValueOrAListStandsForItsKey) {
  const Places read = Read("places: {x: p, y: [q, r], z: {field: s, scale: 2}}\n");
  EXPECT_EQ(read.places,
            (std::map<std::string, Place>{
                {"x", {"p", {}, 1.0}}, {"y", {"", {"q", "r"}, 1.0}}, {"z", {"s", {}, 2.0}}}));
}

TEST(ShortForm, WhatIsWrittenReadsBack) {
  Places places = Read("places: {x: p, z: {field: s, scale: 2}}\nnames: [c, d]\n");
  EXPECT_EQ(ReadConfig<Places>(WriteConfig(places)), places);
}

TEST(ShortForm, ErrorsNameTheKeyWithinTheMap) {
  EXPECT_EQ(ShortFormErrorOf("places: {x: {scale: -1}}\n"),
            "a.yaml:1:21: places.x.scale: -1 is outside [0, .inf]");
  EXPECT_EQ(ShortFormErrorOf("places: {x: {feld: p}}\n"),
            "a.yaml:1:14: places.x.feld: unknown key (did you mean \"field\"?)");
  EXPECT_EQ(ShortFormErrorOf("places: [p]\n").substr(0, 20), "a.yaml:1:9: places: ");
}

TEST(ShortForm, IsDescribed) {
  const FieldInfo info = DescribeConfig<Places>();
  EXPECT_EQ(info.children[0].kind, "map by name");
  EXPECT_TRUE(info.children[0].children[0].has_short_form);
  EXPECT_EQ(info.children[1].kind, "list of 2 strings");
}

}  // namespace
}  // namespace scoria::core
