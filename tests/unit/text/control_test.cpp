// Texts of others as they are shown to people.
#include "text/control.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

TEST(Harmless, ShowsWhatMovesATerminalAsAQuestionMark) {
  EXPECT_EQ(harmless("\x1B[31mred\x07\n\x7F"), "?[31mred???");
  EXPECT_EQ(harmless(std::string_view("a\0b", 3)), "a?b");
  EXPECT_EQ(harmless("\u0085\u009B31m"), "??31m") << "C1: a terminal takes them like ESC [";
}

TEST(Harmless, ShowsWhatTurnsTheTextAroundItAsAQuestionMark) {
  for (const char* mark : {"\u061C", "\u200E", "\u200F", "\u2028", "\u2029", "\u202A", "\u202B",
                           "\u202C", "\u202D", "\u202E", "\u2066", "\u2067", "\u2068", "\u2069"})
    EXPECT_EQ(harmless("no" + std::string(mark) + "abc"), "no?abc") << mark;
}

TEST(Harmless, LeavesWordsAlone) {
  for (const char* words : {"", "box 1", "Kiste \u00FC", "\u7BB1\u5B50", "\u05E9\u05DC\u05D5\u05DD",
                            "\u00A0", "\u061B", "\u200D", "\u2010", "\u2027", "\u202F", "\u2065",
                            "\u206A", "\U0001F4E6", "\xE2\x80", "\xFF\x80"}) {
    EXPECT_EQ(harmless(words), words);
    EXPECT_FALSE(has_control(words)) << words;
  }
  EXPECT_TRUE(has_control("a\u202E"));
}

}  // namespace
}  // namespace drover::text
