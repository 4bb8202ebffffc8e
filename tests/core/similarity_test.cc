// SPDX-License-Identifier: BSD-3-Clause
#include "core/similarity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/config/archive.h"

namespace scoria::core {
namespace {

using namespace dimension;

TEST(Similarity, OfTheGo2IsOneAndOfOthersTheirRatios) {
  EXPECT_TRUE(Similarity::Of(15.019, 0.42600939).IsReference());
  const Similarity b = Similarity::Of(2.0 * 15.019, 0.5 * 0.426);
  EXPECT_DOUBLE_EQ(b.mass, 2.0);
  EXPECT_DOUBLE_EQ(b.length, 0.5);
}

// Equal gravity: accelerations and Froude numbers stay, weights follow the mass.
TEST(Similarity, KeepsGravityAndTheFroudeNumber) {
  const Similarity b{.mass = 3.0, .length = 1.7};
  EXPECT_DOUBLE_EQ(b.Factor(kLength / Pow(kTime, 2.0)), 1.0);
  EXPECT_DOUBLE_EQ(b.Factor(kForce), b.mass);
  const double speed = b.Factor(kSpeed), length = b.Factor(kLength);
  EXPECT_DOUBLE_EQ(speed * speed / length, 1.0);
  EXPECT_DOUBLE_EQ(b.Factor(kTorque), 3.0 * 1.7);
  EXPECT_DOUBLE_EQ(b.Factor(kInertia), 3.0 * 1.7 * 1.7);
  EXPECT_DOUBLE_EQ(b.Factor(kJointDamping), 3.0 * std::pow(1.7, 1.5));
  EXPECT_DOUBLE_EQ(b.Factor(Pow(kForce, -2.0)), 1.0 / 9.0);
  EXPECT_DOUBLE_EQ(b.Factor(kPower / Pow(kTorque, 2.0)), 1.0 / (3.0 * std::pow(1.7, 1.5)));
}

TEST(Similarity, IsToldInMassAndLength) {
  EXPECT_EQ(ScaleText({}), "");
  EXPECT_EQ(ScaleText(kForce), "m");
  EXPECT_EQ(ScaleText(kJointDamping), "m L^1.5");
  EXPECT_EQ(ScaleText(kTime), "L^0.5");
  EXPECT_EQ(ScaleText(Pow(kForce, -2.0)), "m^-2");
}

struct Spring {
  static constexpr const char* kType = "spring";
  double stiffness_Nm = 10.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("stiffness_Nm", stiffness_Nm, {.scale = kTorque});
  }
};
struct Rod {
  static constexpr const char* kType = "rod";
  double length_m = 0.2;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("length_m", length_m, {.scale = kLength});
  }
};
struct Sized {
  double force_N = 5.0, share = 0.5;
  Vec3 p_m = Vec3(1.0, 2.0, 3.0);
  std::variant<Spring, Rod> link;
  std::vector<Rod> rods = {{0.1}, {0.3}};
  std::optional<double> period_s;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("force_N", force_N, {.scale = kForce});
    a.Field("share", share);
    a.Field("p_m", p_m, {.scale = kLength});
    a.Field("link", link);
    a.Field("rods", rods);
    a.Field("period_s", period_s, {.scale = kTime});
  }
};

TEST(Similarity, ScalesDefaultsAndNothingThatIsGiven) {
  ConfigContext context{.similarity = {.mass = 2.0, .length = 4.0}, .notes = {}};
  const auto read = [&](const char* yaml) {
    return ReadConfig<Sized>(ParseConfig(yaml, "a.yaml"), context);
  };
  const Sized derived = read("{}");
  EXPECT_EQ(derived.force_N, 10.0);
  EXPECT_EQ(derived.share, 0.5);
  EXPECT_EQ(derived.p_m, Vec3(4.0, 8.0, 12.0));
  EXPECT_EQ(std::get<Spring>(derived.link).stiffness_Nm, 80.0);
  EXPECT_EQ(derived.rods[1].length_m, 1.2);
  EXPECT_FALSE(derived.period_s);
  const Sized given =
      read("{force_N: 7, link: {type: rod}, rods: [{}, {length_m: 1}], period_s: 3}");
  EXPECT_EQ(given.force_N, 7.0);
  EXPECT_EQ(std::get<Rod>(given.link).length_m, 0.8) << "a default of another alternative";
  EXPECT_EQ(given.rods[0].length_m, 0.8);
  EXPECT_EQ(given.rods[1].length_m, 1.0);
  EXPECT_EQ(given.period_s, 3.0);
  EXPECT_EQ(Scaled(Sized{}, context.similarity).force_N, 10.0);
  // What is written holds every number and is not scaled again.
  const Sized again = ReadConfig<Sized>(WriteConfig(derived), context);
  EXPECT_EQ(again.force_N, derived.force_N);
  EXPECT_EQ(again.p_m, derived.p_m);
}

}  // namespace
}  // namespace scoria::core
