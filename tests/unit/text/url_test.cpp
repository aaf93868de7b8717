#include "text/url.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

TEST(UrlEncoded, KeepsFourMarksAndWritesABlankAsPlus) {
  EXPECT_EQ(url_encoded("aZ09-_.~ /"), "aZ09-_.~+%2F");
}

TEST(UrlEncoded, WritesEveryOtherByteInUpperCaseHex) {
  EXPECT_EQ(url_encoded("+#%*左"), "%2B%23%25%2A%E5%B7%A6");
  EXPECT_EQ(url_encoded(std::string_view("\0\n\x7F", 3)), "%00%0A%7F");
}

}  // namespace
}  // namespace drover::text
