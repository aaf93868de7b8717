#include "runtime/line_hold.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

TEST(LineHold, IsNobodysAtFirst) {
  LineHold hold;
  EXPECT_FALSE(hold.begin());
  EXPECT_FALSE(hold.holds());
  EXPECT_TRUE(hold.take_back());
}

TEST(LineHold, ComesBackOnceItsHolderLetsGo) {
  LineHold hold;
  hold.lend();
  EXPECT_TRUE(hold.begin());
  hold.obey();
  EXPECT_TRUE(hold.holds()) << "nobody wants it back";
  EXPECT_FALSE(hold.take_back());
  EXPECT_FALSE(hold.take_back());
  EXPECT_TRUE(hold.holds()) << "until it obeys";
  hold.obey();
  EXPECT_FALSE(hold.holds());
  EXPECT_TRUE(hold.take_back());
}

/// Else the holder would begin with what is closed already.
TEST(LineHold, ThatWasTakenBackIsNotBegun) {
  LineHold hold;
  hold.lend();
  EXPECT_TRUE(hold.take_back());
  EXPECT_FALSE(hold.begin());
  EXPECT_FALSE(hold.holds());
}

TEST(LineHold, IsLentOnceMore) {
  LineHold hold;
  hold.lend();
  EXPECT_TRUE(hold.begin());
  EXPECT_FALSE(hold.begin()) << "it was begun";
  EXPECT_FALSE(hold.take_back());
  hold.obey();
  EXPECT_TRUE(hold.take_back());
  hold.lend();
  EXPECT_TRUE(hold.begin());
  hold.obey();
  EXPECT_TRUE(hold.holds()) << "what was wanted back was the one before";
}

TEST(LineHold, ComesBackFromAHolderThatEnded) {
  LineHold hold;
  hold.lend();
  EXPECT_TRUE(hold.begin());
  EXPECT_FALSE(hold.take_back());
  hold.let_go();
  EXPECT_TRUE(hold.take_back());
}

}  // namespace
}  // namespace drover::runtime
