#include "json/located_json.h"

#include <gtest/gtest.h>

#include <limits>

#include "json/json_text.h"

namespace drover::json {
namespace {

std::string refusal(std::string_view text, const Limits& limits = {}) {
  const auto result = parse(text, limits);
  return result.ok() ? "accepted" : result.error().text();
}

TEST(LocatedJson, RefusesWhatIsNoJson) {
  for (const std::string_view text : {"",          " ",         "// only a comment",
                                      "{",         "[1,]",      "{\"a\":1,}",
                                      "[1 2]",     "nul",       "NaN",
                                      "Infinity",  "-Infinity", "'a'",
                                      "{a:1}",     "01",        "+1",
                                      ".5",        "1.",        "0x10",
                                      "\"\t\"",    "\"\\x\"",   "/* open",
                                      "{} {}",     "{}x",       "[1],",
                                      "1 // c\n2", "undefined", "\"open"}) {
    EXPECT_NE(refusal(text), "accepted") << text;
  }
}

TEST(LocatedJson, SaysWhereACommaOrAColonIsMissing) {
  EXPECT_EQ(refusal("{\n  \"a\": 1\n  \"b\": 2}"),
            "line 3, column 3: a comma is missing before this");
  EXPECT_EQ(refusal("{\"a\": {\"b\": 1} // c\n  \"d\": 2}"),
            "line 2, column 3: a comma is missing before this");
  EXPECT_EQ(refusal(std::string_view("{\n  \0", 5)), "line 2, column 3: contains a NUL byte");
  EXPECT_EQ(refusal("[1 2]"), "line 1, column 4 ([1]): a comma is missing before this");
  EXPECT_EQ(refusal("[{} {}]"), "line 1, column 5 ([1]): a comma is missing before this");
  EXPECT_EQ(refusal("[\"x\"\n true]"), "line 2, column 2 ([1]): a comma is missing before this");
  EXPECT_NE(refusal("{\"a\" 1}").find("a colon is missing before this"), std::string::npos);
  EXPECT_EQ(refusal("{} {}").find("comma"), std::string::npos);
}

TEST(LocatedJson, SaysThatACommaIsTooMany) {
  EXPECT_EQ(refusal("{\"a\": 1,}"), "line 1, column 9: there is a comma too many before this");
  EXPECT_EQ(refusal("[1,]"), "line 1, column 4 ([1]): there is a comma too many before this");
  EXPECT_EQ(refusal("[1,,2]"), "line 1, column 4 ([1]): there is a comma too many before this");
  EXPECT_EQ(refusal("{\"a\": 1,, \"b\": 2}"),
            "line 1, column 9: there is a comma too many before this");
  EXPECT_EQ(refusal("[,1]"), "line 1, column 2 ([0]): there is a comma too many before this");
}

// What people write who come from shell, Python and YAML.
TEST(LocatedJson, SaysHowAWordThatIsNoJsonIsWritten) {
  const auto tells = [](std::string_view text, std::string_view piece) {
    EXPECT_NE(refusal(text).find(piece), std::string::npos) << refusal(text);
  };
  EXPECT_EQ(refusal("{\n# left\n}"),
            "line 2, column 1: '#' begins no comment: // does, and /* ... */");
  tells("# first\n{}", "line 1, column 1: '#' begins no comment");
  tells("{\"a\": 1 # left\n}", "line 1, column 9");
  tells("{\"a\": 1 # left\n}", "'#' begins no comment");
  EXPECT_EQ(refusal("{\"a\": True}"), "line 1, column 7 (a): it is written true, in small letters");
  EXPECT_EQ(refusal("[False]"), "line 1, column 2 ([0]): it is written false, in small letters");
  EXPECT_EQ(refusal("[NULL]"), "line 1, column 2 ([0]): it is written null, in small letters");
  EXPECT_EQ(refusal("[None]"), "line 1, column 2 ([0]): it is written null");
  EXPECT_EQ(refusal("{\"a\": yes}"), "line 1, column 7 (a): \"yes\" needs quotes, or is it true?");
  EXPECT_EQ(refusal("{\"a\": off}"), "line 1, column 7 (a): \"off\" needs quotes, or is it false?");
  EXPECT_EQ(refusal("{'a': 1}"), "line 1, column 2: texts and keys stand in \"double quotes\"");
  EXPECT_EQ(refusal("{\"a\": 'b'}"),
            "line 1, column 7 (a): texts and keys stand in \"double quotes\"");
  EXPECT_EQ(refusal("{a: 1}"), "line 1, column 2: \"a\" needs quotes");
  EXPECT_EQ(refusal("{\"a\": can0}"), "line 1, column 7 (a): \"can0\" needs quotes");
  EXPECT_EQ(refusal("[.5]"), "line 1, column 2 ([0]): a number begins with a digit, as 0.5 does");
  EXPECT_EQ(refusal("[+1]"), "line 1, column 2 ([0]): a number has no + before it");
  EXPECT_EQ(refusal("[0x28]"),
            "line 1, column 3 ([1]): there are no hexadecimal numbers: write 40; or, of an address "
            "in a register map, \"0x28\" in quotes");
  EXPECT_EQ(refusal("{\"id\": 0X1f}"),
            "line 1, column 9: there are no hexadecimal numbers: write 31; or, of an address "
            "in a register map, \"0x1f\" in quotes");
  EXPECT_EQ(refusal("[0xg]"), "line 1, column 3 ([1]): there are no hexadecimal numbers");
}

TEST(LocatedJson, RefusesADuplicateKeyAndTellsItsPlace) {
  EXPECT_EQ(refusal("{\"a\": {\n  \"x\": 1,\n  \"x\": 2}}"),
            "line 3, column 3 (a.x): this key is there twice");
}

TEST(LocatedJson, RefusesADuplicateKeyInALargeObject) {
  std::string text = "{";
  for (int i = 0; i < 1000; ++i) text += "\"k" + std::to_string(i) + "\":0,";
  EXPECT_NE(refusal(text + "\"k500\":0}").find("twice"), std::string::npos);
  EXPECT_EQ(refusal(text + "\"k1000\":0}"), "accepted");
}

TEST(LocatedJson, TakesEscapedSpellingsOfOneKeyForTheSameKey) {
  EXPECT_NE(refusal("{\"a\":1,\"\\u0061\":2}").find("twice"), std::string::npos);
}

TEST(LocatedJson, RefusesDepthBeyondTheLimitWhileParsing) {
  const std::string open(1'000'000, '[');
  EXPECT_NE(refusal(open).find("nested deeper than 16"), std::string::npos);
  EXPECT_EQ(refusal(std::string(16, '[') + std::string(16, ']')), "accepted");
  EXPECT_NE(refusal(std::string(17, '[') + std::string(17, ']')), "accepted");
}

TEST(LocatedJson, RefusesMoreBytesOrValuesThanTheLimit) {
  EXPECT_NE(refusal("[1,2,3]", {.max_bytes = 6}).find("7 bytes"), std::string::npos);
  EXPECT_NE(refusal("[1,2,3]", {.max_values = 3}).find("more than 3 values"), std::string::npos);
  EXPECT_EQ(refusal("[1,2,3]", {.max_bytes = 7, .max_values = 4}), "accepted");
}

TEST(LocatedJson, RefusesNumbersThatDoNotFit) {
  EXPECT_NE(refusal("[1e999]"), "accepted");
  EXPECT_NE(refusal("[-1e999]"), "accepted");
  EXPECT_EQ(refusal("[1, 18446744073709551616]"),
            "line 1, column 5 ([1]): integer does not fit into 64 bits");
  EXPECT_NE(refusal("[-9223372036854775809]"), "accepted");
}

TEST(LocatedJson, TakesLongIntegersForNumbersWhereTheyAreAskedFor) {
  const std::string_view text = "[18446744073709551616,-98765432109876543210]";
  const auto read = parse(text, {.long_integers = true});
  ASSERT_TRUE(read.ok());
  const Node& first = read->root.list()->at(0);
  EXPECT_EQ(first.number(), 18446744073709551616.0);
  EXPECT_FALSE(first.integer());
  EXPECT_EQ(first.spelling(text), "18446744073709551616");
  EXPECT_NE(refusal("[1" + std::string(400, '0') + "]", {.long_integers = true}), "accepted");
}

TEST(LocatedJson, RefusesBadUnicode) {
  for (const std::string_view text :
       {"\"\xFF\"", "\"\xC0\xAF\"", "\"\xED\xA0\x80\"", "\"\xE5\x9B\"", "\"\\ud800\"",
        "\"\\udc00\"", "\"\\ud800x\"", "\xEF\xBB\xBF{}"}) {
    EXPECT_NE(refusal(text), "accepted");
  }
}

TEST(LocatedJson, RefusesANulByteInsteadOfStoppingThere) {
  EXPECT_NE(refusal(std::string_view("{}\0garbage", 10)), "accepted");
  EXPECT_NE(refusal(std::string_view("{}\0", 3)), "accepted");
}

TEST(LocatedJson, KeepsAnErrorMessageShortAndFreeOfTheInput) {
  const std::string message = refusal("[\"" + std::string(500'000, 'a') + "\xFF\"]");
  EXPECT_LT(message.size(), 300U);
  EXPECT_EQ(message.find('\xFF'), std::string::npos);
}

TEST(LocatedJson, PointsAtTheTokenThatIsWrong) {
  EXPECT_EQ(refusal("{\n  \"a\": 1\n  \"b\": 2\n}").substr(0, 16), "line 3, column 3");
  EXPECT_EQ(refusal("[1,,2]").substr(0, 16), "line 1, column 4");
  EXPECT_EQ(refusal("{\"园\": nul}").substr(0, 16), "line 1, column 7");
}

TEST(LocatedJson, TellsIntegersFromOtherNumbers) {
  const auto parsed = parse("[1, 1.0, 1.9, true, 4294967297, -0, 18446744073709551615, 1e0, -5]");
  ASSERT_TRUE(parsed.ok());
  const auto& items = *parsed->root.list();
  EXPECT_EQ(items[0].integer(), 1);
  EXPECT_EQ(items[1].integer(), std::nullopt);
  EXPECT_EQ(items[1].number(), 1.0);
  EXPECT_EQ(items[2].integer(), std::nullopt);
  EXPECT_EQ(items[3].integer(), std::nullopt);
  EXPECT_EQ(items[3].number(), std::nullopt);
  EXPECT_EQ(items[4].integer(), 4294967297);
  EXPECT_EQ(items[5].integer(), 0);
  EXPECT_EQ(items[6].integer(), std::nullopt);
  EXPECT_TRUE(items[6].number().has_value());
  EXPECT_EQ(items[7].integer(), std::nullopt);
  EXPECT_EQ(items[8].integer(), -5);
}

TEST(LocatedJson, KeepsANulInsideATextVisible) {
  const auto parsed = parse("\"a\\u0000/../x\"");
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(*parsed->root.text(), std::string("a\0/../x", 7));
}

TEST(LocatedJson, TellsWhereEachValueStandsPastCommentsAndWideCharacters) {
  const auto parsed =
      parse("{ // 电池信息：注释，\n  \"园区\": 12/*x*/,\n\t\"b\":[ -1.5e3,\n{}] }");
  ASSERT_TRUE(parsed.ok()) << parsed.error().text();
  const Node* first = parsed->root.find("园区");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->line, 2U);
  EXPECT_EQ(first->column, 9U);
  const Node* list = parsed->root.find("b");
  EXPECT_EQ(list->line, 3U);
  EXPECT_EQ(list->column, 6U);
  EXPECT_EQ((*list->list())[0].column, 8U);
  EXPECT_EQ((*list->list())[1].line, 4U);
  EXPECT_EQ((*list->list())[1].column, 1U);
  EXPECT_EQ(parsed->root.object()->at(1).line, 3U);
  EXPECT_EQ(parsed->root.object()->at(1).column, 2U);
}

TEST(LocatedJson, ShowsForeignTextOnOneShortLine) {
  EXPECT_EQ(refusal("{\"a\\nb\":{\"x\":1,\"x\":2}}"),
            "line 1, column 16 (a?b.x): this key is there twice");
  // What the parser read last is not quoted, whatever it looks like.
  EXPECT_EQ(refusal("/*'; expected \xAD"),
            "line 1, column 15: syntax error while parsing value - invalid comment; missing "
            "closing '*/'");
  EXPECT_EQ(refusal("{\"; expected x"),
            "line 1, column 2: syntax error while parsing object key - invalid string: missing "
            "closing quote; expected string literal");
  EXPECT_EQ(refusal("[1"),
            "line 1, column 3 ([1]): syntax error while parsing array - unexpected end of input; "
            "expected ']'");
  EXPECT_EQ(shown("园区01", 5), "园...");
  EXPECT_EQ(shown("园区01", 8), "园区01");
  EXPECT_EQ(shown("no\u202E\u2066\u0085\x1B"
                  "abc",
                  40),
            "no????abc");
}

TEST(JsonText, WritesNumbersThatReadBackToTheSameBits) {
  for (const double value :
       {0.004363323129985824, 113.0196366456667, 23.1496524965, -0.0, 1e-300, 188.2222333,
        1.7976931348623157e308, 0.1 + 0.2,
        // As many digits as an integer has that fits into 64 bits, or not.
        9223372036854775808.0, 25123456789012344832.0, -123456789012345683968.0}) {
    JsonText out;
    out.open('[').number(value).close(']');
    const auto parsed = parse(out.str());
    ASSERT_TRUE(parsed.ok()) << out.str();
    EXPECT_EQ((*parsed->root.list())[0].number(), value) << out.str();
  }
}

TEST(JsonText, RoundsToDecimalsWithoutZerosBehind) {
  const auto written = [](double value, int decimals) {
    return JsonText().number(value, decimals).take();
  };
  EXPECT_EQ(written(-1.199999999999818, 2), "-1.2");
  EXPECT_EQ(written(67.5001, 0), "68");
  EXPECT_EQ(written(100, 0), "100");
  EXPECT_EQ(written(100, 2), "100");
  EXPECT_EQ(written(-0.0001, 2), "0");
  EXPECT_EQ(written(113.01964, 4), "113.0196");
  EXPECT_EQ(written(1e300, 2), "1e+300");
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN(), 2), "0");
}

TEST(JsonText, EscapesWhatMustBeAndReplacesWhatIsNoText) {
  JsonText out;
  out.open('{')
      .key("a\"b")
      .text("x\n\\ 园 \xFF \x01")
      .key("n")
      .number(std::numeric_limits<double>::infinity())
      .close('}');
  EXPECT_EQ(out.str(), "{\"a\\\"b\":\"x\\u000a\\\\ 园 \xEF\xBF\xBD \\u0001\",\"n\":0}");
}

}  // namespace
}  // namespace drover::json
