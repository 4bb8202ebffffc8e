// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/texture_colour.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

TEST(MeanColour, IsOfTheWholeImage) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.ppm") << "P3 2 1 255  255 0 0  0 0 102\n";
  const auto colour = MeanColour(folder.path() / "a.ppm");
  ASSERT_TRUE(colour.has_value());
  EXPECT_LT((*colour - Vec3(0.5, 0.0, 0.2)).norm(), 1e-9);
  std::ofstream(folder.path() / "grey.pgm") << "P2 2 1 255  51 153\n";
  EXPECT_LT((*MeanColour(folder.path() / "grey.pgm") - Vec3::Constant(0.4)).norm(), 1e-9);
}

TEST(MeanColour, OfWhatIsNoImageIsNone) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.png") << "none";
  EXPECT_FALSE(MeanColour(folder.path() / "a.png").has_value());
  EXPECT_FALSE(MeanColour(folder.path() / "gone.png").has_value());
  EXPECT_FALSE(MeanColour("").has_value());
}

}  // namespace
}  // namespace scoria::analysis
