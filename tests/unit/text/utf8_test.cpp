#include "text/utf8.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

TEST(CharacterBytes, AreThoseOfTheCharacterAtTheFront) {
  EXPECT_EQ(character_bytes("ab"), 1U);
  EXPECT_EQ(character_bytes(std::string_view("\0", 1)), 1U);
  EXPECT_EQ(character_bytes("\u00E9b"), 2U);
  EXPECT_EQ(character_bytes("\u2028"), 3U);
  EXPECT_EQ(character_bytes("\uD7FF"), 3U);
  EXPECT_EQ(character_bytes("\U0010FFFF"), 4U);
}

TEST(CharacterBytes, AreNoneWhereThereIsNoCharacter) {
  for (const char* text :
       {"\x80", "\xC1\xBF", "\xC3", "\xC3z", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xE2\x80",
        "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xF0\x9F\x98", "\xFF"})
    EXPECT_EQ(character_bytes(text), 0U) << text;
}

}  // namespace
}  // namespace drover::text
