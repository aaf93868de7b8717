#include "drover/fixed_vector.h"

#include <gtest/gtest.h>

namespace drover {
namespace {

int copies = 0;

/// Counts how often one is made or overwritten.
struct Counted {
  Counted() = default;
  Counted(int value) : number(value) {}
  Counted(const Counted& other) : number(other.number) { ++copies; }
  Counted& operator=(const Counted& other) {
    number = other.number;
    ++copies;
    return *this;
  }
  int number = -1;
};

TEST(FixedVector, CopiesWhatIsInItAndNothingElse) {
  FixedVector<Counted, 1000> three;
  for (const int i : {1, 2, 3}) ASSERT_TRUE(three.push_back(i));
  copies = 0;
  const FixedVector<Counted, 1000> made = three;
  EXPECT_EQ(copies, 3);
  FixedVector<Counted, 1000> assigned;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(assigned.push_back(i));
  copies = 0;
  assigned = made;
  EXPECT_EQ(copies, 3);
  ASSERT_EQ(assigned.size(), 3U);
  EXPECT_EQ(assigned[0].number, 1);
  EXPECT_EQ(assigned.back().number, 3);
}

TEST(FixedVector, GrowsByFreshValuesWhateverWasThereBefore) {
  FixedVector<int, 4> list;
  for (const int i : {1, 2, 3, 4}) ASSERT_TRUE(list.push_back(i));
  EXPECT_FALSE(list.push_back(5));
  list.clear();
  list.resize(3);
  ASSERT_EQ(list.size(), 3U);
  for (const int i : list) EXPECT_EQ(i, 0);
  list.resize(99);
  EXPECT_TRUE(list.full());
}

TEST(FixedVector, MakesAValueInItsPlaceAndNoneWhenFull) {
  FixedVector<Counted, 2> list;
  int made = 0;
  const auto make = [&made] { return Counted(++made); };
  copies = 0;
  EXPECT_TRUE(list.push_made(make));
  EXPECT_TRUE(list.push_made(make));
  EXPECT_FALSE(list.push_made(make));
  EXPECT_EQ(copies, 0);
  EXPECT_EQ(made, 2);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].number, 1);
  EXPECT_EQ(list[1].number, 2);
}

TEST(FixedVector, OutlivesBeingCopiedToItself) {
  FixedVector<int, 4> list;
  ASSERT_TRUE(list.push_back(7));
  const auto& same = list;
  list = same;
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0], 7);
}

}  // namespace
}  // namespace drover
