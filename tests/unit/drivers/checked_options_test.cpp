#include "drivers/checked_options.h"

#include <gtest/gtest.h>

#include <limits>

namespace drover {
namespace {

constexpr std::string_view kLevels[] = {"low", "high"};
const OptionSpec kTable[] = {
    {.name = "stale_s", .default_value = 0.5, .min = 0.1, .max = 10.0, .text = "limit"},
    {.name = "level", .default_value = std::string("low"), .choices = kLevels, .text = "level"},
    {.name = "offset_deg", .default_value = 0.0, .text = "any angle"},
    {.name = "loud", .default_value = true, .text = "a flag"},
    {.name = "node", .default_value = 1.0, .max = 62.0, .integer = true, .text = "a node"},
    {.name = "label", .default_value = std::string("any"), .text = "any text"},
};

std::string refusal(const Options& options, std::string_view name) {
  try {
    const CheckedOptions checked(options, kTable);
    if (name == "stale_s") (void)checked.number(name);
    if (name != "stale_s") (void)checked.text(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CheckedOptions, AreThoseOfTheTable) {
  const Options defaults(kTable);
  const CheckedOptions checked(defaults, kTable);
  EXPECT_EQ(checked.number("stale_s"), 0.5);
  EXPECT_EQ(checked.seconds("stale_s"), std::chrono::milliseconds(500));
  EXPECT_EQ(checked.text("level"), "low");
  EXPECT_EQ(checked.text("label"), "any");
}

TEST(CheckedOptions, RefuseANumberOutsideItsRangeOrNone) {
  for (const auto& [bad, told] : {std::pair(0.09, "0.09"), {10.1, "10.1"}, {-1.0, "-1"}})
    EXPECT_EQ(refusal(Options(kTable).set("stale_s", bad), "stale_s"),
              "stale_s is " + std::string(told) + ", but must be between 0.1 and 10");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(refusal(Options(kTable).set("stale_s", bad), "stale_s"), "stale_s is no number");
}

TEST(CheckedOptions, RefuseAnotherType) {
  EXPECT_EQ(refusal(Options(kTable).set("stale_s", true), "stale_s"), "stale_s must be a number");
  EXPECT_EQ(refusal(Options(kTable).set("level", 1.0), "level"), "level must be a text");
  EXPECT_EQ(refusal(Options(kTable).set("loud", 1.0), "loud"), "loud must be true or false");
}

TEST(CheckedOptions, RefuseAFractionWhereAWholeNumberStands) {
  EXPECT_EQ(refusal(Options(kTable).set("node", 1.5), "node"), "node must be a whole number");
}

TEST(CheckedOptions, LookAtAllOfTheTableWhateverIsRead) {
  EXPECT_EQ(refusal(Options(kTable).set("node", 64.0), "level"),
            "node is 64, but must be between 0 and 62");
  EXPECT_EQ(refusal(Options(), "level"), "stale_s is missing");
}

TEST(CheckedOptions, TakeAnyNumberWhereTheTableHasNoRange) {
  const auto given = Options(kTable).set("offset_deg", -400.0);
  EXPECT_EQ(CheckedOptions(given, kTable).number("offset_deg"), -400.0);
}

TEST(CheckedOptions, RefuseATextThatIsNoChoice) {
  EXPECT_EQ(refusal(Options(kTable).set("level", std::string("up")), "level"),
            "level must be \"low\" or \"high\"");
}

TEST(CheckedOptions, RefuseANameThatTheTableDoesNotHave) {
  EXPECT_EQ(refusal(Options(kTable).set("other", std::string("x")), "other"), "other is no option");
}

}  // namespace
}  // namespace drover
