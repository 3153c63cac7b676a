#include "core/formation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace skein {
namespace {

constexpr Shape kShapes[] = {Shape::kTriangle,     Shape::kColumn,  Shape::kLineAbreast, Shape::kEchelonLeft,
                             Shape::kEchelonRight, Shape::kDiamond, Shape::kVee};

void ExpectSlot(const SlotOffset& slot, double forward_m, double left_m) {
  EXPECT_NEAR(slot.forward_m, forward_m, 1e-3);
  EXPECT_NEAR(slot.left_m, left_m, 1e-3);
  EXPECT_EQ(slot.up_m, 0);
}

double NearestDistance(const std::vector<SlotOffset>& slots) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      nearest = std::min(
          nearest, std::hypot(slots[i].forward_m - slots[j].forward_m, slots[i].left_m - slots[j].left_m));
    }
  }
  return nearest;
}

TEST(Formation, TriangleOfThreeIsEquilateralBehindTheLeader) {
  const auto slots = ShapeSlots(Shape::kTriangle, 3, 500);
  ASSERT_EQ(slots.size(), 3u);
  ExpectSlot(slots[0], -1000, 0);
  ExpectSlot(slots[1], -1000 - 433.0127, 250);
  ExpectSlot(slots[2], -1000 - 433.0127, -250);
}

TEST(Formation, TriangleWithAnIncompleteRowStaysBalanced) {
  const auto slots = ShapeSlots(Shape::kTriangle, 5, 500);
  ASSERT_EQ(slots.size(), 5u);
  ExpectSlot(slots[3], -1000 - 433.0127 - 500, 250);
  ExpectSlot(slots[4], -1000 - 433.0127 - 500, -250);
}

TEST(Formation, ColumnIsOneBehindTheOther) {
  const auto slots = ShapeSlots(Shape::kColumn, 3, 400, 800);
  ExpectSlot(slots[0], -800, 0);
  ExpectSlot(slots[1], -1200, 0);
  ExpectSlot(slots[2], -1600, 0);
}

TEST(Formation, LineAbreastIsCentredFromLeftToRight) {
  const auto even = ShapeSlots(Shape::kLineAbreast, 2, 500);
  ExpectSlot(even[0], -1000, 250);
  ExpectSlot(even[1], -1000, -250);
  const auto odd = ShapeSlots(Shape::kLineAbreast, 3, 500);
  ExpectSlot(odd[0], -1000, 500);
  ExpectSlot(odd[1], -1000, 0);
  ExpectSlot(odd[2], -1000, -500);
}

TEST(Formation, EchelonsTrailToTheirSide) {
  ExpectSlot(ShapeSlots(Shape::kEchelonLeft, 2, 500)[1], -1000 - 353.5534, 353.5534);
  ExpectSlot(ShapeSlots(Shape::kEchelonRight, 2, 500)[1], -1000 - 353.5534, -353.5534);
}

TEST(Formation, DiamondOfFourIsASquareOnItsCorner) {
  const auto slots = ShapeSlots(Shape::kDiamond, 4, 500);
  ExpectSlot(slots[0], -1000, 0);
  ExpectSlot(slots[1], -1000 - 353.5534, 353.5534);
  ExpectSlot(slots[2], -1000 - 353.5534, -353.5534);
  ExpectSlot(slots[3], -1000 - 707.1068, 0);
}

TEST(Formation, VeeSpreadsLeftAndRightInTurn) {
  const auto slots = ShapeSlots(Shape::kVee, 4, 500);
  ExpectSlot(slots[0], -1000, 0);
  ExpectSlot(slots[1], -1000 - 353.5534, 353.5534);
  ExpectSlot(slots[2], -1000 - 353.5534, -353.5534);
  ExpectSlot(slots[3], -1000 - 707.1068, 707.1068);
}

TEST(Formation, NobodyIsNearerThanTheSpacingInAnyShapeOfAnySize) {
  for (const Shape shape : kShapes) {
    for (int count = 2; count <= 60; ++count) {
      const auto slots = ShapeSlots(shape, count, 300);
      ASSERT_EQ(static_cast<int>(slots.size()), count);
      EXPECT_GE(NearestDistance(slots), 300 - 1e-9) << Name(shape) << " of " << count;
    }
  }
}

TEST(Formation, FirstSlotIsForemostAndTheLeadBehindTheLeader) {
  for (const Shape shape : kShapes) {
    for (int count = 1; count <= 30; ++count) {
      const auto slots = ShapeSlots(shape, count, 300, 1000);
      EXPECT_EQ(slots[0].forward_m, -1000) << Name(shape) << " of " << count;
      for (const SlotOffset& slot : slots) EXPECT_LE(slot.forward_m, -1000) << Name(shape) << " of " << count;
    }
  }
}

TEST(Formation, TrianglesDiamondsAndLinesAreBalanced) {
  for (const Shape shape : {Shape::kTriangle, Shape::kDiamond, Shape::kLineAbreast}) {
    for (int count = 1; count <= 60; ++count) {
      double sum = 0;
      for (const SlotOffset& slot : ShapeSlots(shape, count, 300)) sum += slot.left_m;
      EXPECT_NEAR(sum, 0, 1e-6) << Name(shape) << " of " << count;
    }
  }
}

TEST(Formation, OfOneIsTheLeadBehindTheLeaderAndOfNoneIsEmpty) {
  for (const Shape shape : kShapes) {
    EXPECT_TRUE(ShapeSlots(shape, 0, 500).empty());
    ExpectSlot(ShapeSlots(shape, 1, 500).at(0), -1000, 0);
  }
}

TEST(Formation, RefusesWhatMakesNoSense) {
  EXPECT_THROW(ShapeSlots(Shape::kCustom, 3, 500), std::invalid_argument);
  EXPECT_THROW(ShapeSlots(Shape::kVee, -1, 500), std::invalid_argument);
  EXPECT_THROW(ShapeSlots(Shape::kVee, 3, 0), std::invalid_argument);
  EXPECT_THROW(ShapeSlots(Shape::kVee, 3, std::nan("")), std::invalid_argument);
  EXPECT_THROW(ShapeSlots(Shape::kVee, 3, 500, -1), std::invalid_argument);
}

TEST(Formation, NamesGoThereAndBack) {
  for (const Shape shape : kShapes) EXPECT_EQ(ShapeFromName(Name(shape)), shape);
  EXPECT_EQ(ShapeFromName("custom"), Shape::kCustom);
  EXPECT_EQ(ShapeFromName("Triangle"), std::nullopt);
  EXPECT_EQ(ShapeFromName(""), std::nullopt);
}

}  // namespace
}  // namespace skein
