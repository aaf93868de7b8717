#include "store/named_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr NamedTextsFile kFile{"things.texts", "drover-things", 5, 4000};
const std::string kPath = "state/things.texts";

std::vector<NamedText> odd_texts() {
  return {{"a", "", 0, ""},
          {"a", "\xE5\x9B\xAD", 1700000000.123456, "{\"text\":\"\\u0000\"}"},
          {"b", "", -1.5, std::string("\0\n{\"kind\":\"a\"}\n\xFF", 16)},
          {"b", "line\nbreak \"quoted\"", 1e300, "\n}\n"}};
}

TEST(NamedTexts, ComeBackByteForByteInTheirOrder) {
  FaultFiles files;
  ASSERT_FALSE(save_named_texts(files, "state", kFile, odd_texts()));
  const LoadedTexts found = load_named_texts(files, "state", kFile);
  EXPECT_THAT(found.problem, IsEmpty());
  EXPECT_EQ(found.texts, odd_texts());
}

TEST(NamedTexts, AreNoneWhereNoneWereStored) {
  FaultFiles files;
  const LoadedTexts found = load_named_texts(files, "state", kFile);
  EXPECT_THAT(found.problem, IsEmpty());
  EXPECT_THAT(found.texts, IsEmpty());
  EXPECT_FALSE(found.is_there);
}

TEST(NamedTexts, AreRefusedWhereTheyWouldNotComeBack) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const NamedText& bad : {NamedText{"a", "latin \xE9", 0, ""}, NamedText{"\xFF", "b", 0, ""},
                               NamedText{"a", "b", nan, ""},
                               NamedText{"a", "b", -std::numeric_limits<double>::infinity(), ""}}) {
    const auto encoded = encode_named_texts(kFile, {bad});
    ASSERT_FALSE(encoded.ok());
    EXPECT_THAT(encoded.error().text, HasSubstr("UTF-8"));
  }
}

TEST(NamedTexts, AreRefusedBeyondTheirBounds) {
  const std::vector<NamedText> many = {{"a", "1", 0, ""}, {"a", "2", 0, ""}, {"a", "3", 0, ""},
                                       {"a", "4", 0, ""}, {"a", "5", 0, ""}, {"a", "6", 0, ""}};
  EXPECT_THAT(encode_named_texts(kFile, many).error().text, HasSubstr("6 are more than 5"));
  EXPECT_THAT(encode_named_texts(kFile, {{"a", "b", 0, std::string(4000, 'x')}}).error().text,
              HasSubstr("more than 4000 bytes"));
  const auto twice = encode_named_texts(kFile, {{"a", "b", 0, ""}, {"a", "b", 1, ""}});
  EXPECT_THAT(twice.error().text, HasSubstr("there twice"));
}

TEST(NamedTexts, OfAnyAcknowledgedSizeCanBeReadAgain) {
  FaultFiles files;
  std::size_t stored = 0;
  for (std::size_t bytes = 3700; bytes < 4000; ++bytes) {
    const std::vector<NamedText> one = {{"a", "b", 0, std::string(bytes, 'x')}};
    if (save_named_texts(files, "state", kFile, one)) continue;
    ++stored;
    EXPECT_EQ(load_named_texts(files, "state", kFile).texts, one) << bytes;
  }
  EXPECT_GT(stored, 50U);
  EXPECT_LT(stored, 250U);
}

TEST(NamedTexts, AnyFlippedOrMissingByteIsNoticed) {
  const std::string good = *encode_named_texts(kFile, odd_texts());
  ASSERT_TRUE(decode_named_texts(kFile, good).ok());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    EXPECT_FALSE(decode_named_texts(kFile, bad).ok()) << i;
    EXPECT_FALSE(decode_named_texts(kFile, good.substr(0, i)).ok()) << i;
  }
}

TEST(NamedTexts, RefuseABodyThatIsSealedButTellsNothing) {
  for (const char* body :
       {"x", "\n", "{}\n\n", "{\"kind\":\"a\",\"name\":\"b\",\"arrived_s\":0,\"bytes\":5}\n1234\n",
        "{\"kind\":\"a\",\"name\":\"b\",\"arrived_s\":0,\"bytes\":-1}\n\n",
        "{\"kind\":\"a\",\"name\":\"b\",\"arrived_s\":0,\"bytes\":9223372036854775807}\n\n",
        "{\"kind\":\"a\",\"name\":\"b\",\"arrived_s\":0,\"bytes\":3}\n1234\n"}) {
    const auto found = decode_named_texts(kFile, seal("drover-things", 1, body));
    ASSERT_FALSE(found.ok()) << body;
    EXPECT_THAT(found.error().text, HasSubstr("text 1"));
  }
}

TEST(NamedTexts, TellWhatCanNeverBeReadFromWhatMayBeReadLater) {
  struct Unreadable final : FaultFiles {
    int read(const std::string&, std::size_t, std::string&) override { return EIO; }
  } unreadable;
  const LoadedTexts later = load_named_texts(unreadable, "state", kFile);
  EXPECT_THAT(later.problem, HasSubstr(kPath));
  EXPECT_FALSE(later.is_damaged);
  FaultFiles files;
  files.put(kPath, std::string(4001, 'x'));
  EXPECT_TRUE(load_named_texts(files, "state", kFile).is_damaged);
  files.put(kPath, "{");
  EXPECT_TRUE(load_named_texts(files, "state", kFile).is_damaged);
  EXPECT_THAT(load_named_texts(files, "state", kFile).problem, HasSubstr(kPath));
}

TEST(NamedTexts, LeftoversOfInterruptedSavesAreRemovedAndNothingElse) {
  FaultFiles files;
  for (const char* name : {"things.texts", "things.texts.0.tmp", "things.texts.7.tmp",
                           "things.texts.bad", "other.texts.0.tmp"})
    files.put("state/" + std::string(name), "");
  remove_leftovers(files, "state", kFile);
  std::vector<std::string> names;
  files.list("state", names);
  EXPECT_THAT(names, testing::UnorderedElementsAre("things.texts", "things.texts.bad",
                                                   "other.texts.0.tmp"));
}

}  // namespace
}  // namespace drover::store
