#include "text/suggestion.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

const std::vector<std::string> kKeys{"max_speed_mps", "min_speed_mps", "port", "baud"};

TEST(Suggestion, FindsASlipOfAFewLetters) {
  EXPECT_EQ(nearest("prot", kKeys), "port");
  EXPECT_EQ(nearest("max_sped_mps", kKeys), "max_speed_mps");
  EXPECT_EQ(did_you_mean("bauds", kKeys), "did you mean \"baud\"?");
}

TEST(Suggestion, FindsAForgottenUnit) {
  EXPECT_EQ(nearest("max_speed", kKeys), "max_speed_mps");
}

TEST(Suggestion, DoesNotMindCapitals) {
  EXPECT_EQ(nearest("PORT", kKeys), "port");
  EXPECT_EQ(nearest("Max_Speed", kKeys), "max_speed_mps");
  EXPECT_EQ(nearest("ZLAC8015D", {"odrive", "zlac8015d"}), "zlac8015d");
  EXPECT_EQ(nearest("gt01", {"GT01_can"}), "GT01_can");
}

TEST(Suggestion, SaysNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest("wheel_radius", kKeys), "");
  EXPECT_EQ(did_you_mean("wheel_radius", kKeys), "");
  EXPECT_EQ(did_you_mean("anything", {}), "");
}

}  // namespace
}  // namespace drover::text
