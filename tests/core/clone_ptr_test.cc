// SPDX-License-Identifier: BSD-3-Clause
#include "core/clone_ptr.h"

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

struct Figure {
  virtual ~Figure() = default;
  [[nodiscard]] virtual int Sides() const = 0;
  virtual void Grow() = 0;
  [[nodiscard]] virtual std::unique_ptr<Figure> Clone() const = 0;
};
struct Polygon final : Figure {
  explicit Polygon(int n) : sides(n) {}
  int Sides() const override { return sides; }
  void Grow() override { ++sides; }
  std::unique_ptr<Figure> Clone() const override { return std::make_unique<Polygon>(*this); }
  int sides;
};
struct Owner {
  ClonePtr<Figure> shape;
  ClonePtr<int> number;
};

TEST(ClonePtr, CopyOfAnOwnerHasPartsOfItsOwn) {
  Owner owner{std::make_unique<Polygon>(3), std::make_unique<int>(7)};
  Owner copy = owner;
  copy.shape->Grow();
  *copy.number = 8;
  EXPECT_EQ(owner.shape->Sides(), 3);
  EXPECT_EQ(copy.shape->Sides(), 4);
  EXPECT_EQ(*owner.number, 7);
  owner = copy;
  EXPECT_EQ(owner.shape->Sides(), 4);
  owner.shape->Grow();
  EXPECT_EQ(copy.shape->Sides(), 4);
}

TEST(ClonePtr, CopyOfNothingIsNothing) {
  const Owner empty;
  const Owner copy = empty;
  EXPECT_FALSE(copy.shape);
  EXPECT_FALSE(copy.number);
}

}  // namespace
}  // namespace scoria::core
