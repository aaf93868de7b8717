// A hundred messages with one thing wrong each, made by taking apart good ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <span>

#include "json/located_json.h"
#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

struct Place {
  std::size_t begin;
  std::size_t end;
};

/// Where each value stands that is no object and no list.
void scalars(const json::Node& node, std::string_view text, std::vector<Place>& out) {
  if (const auto* members = node.object()) {
    for (const json::Member& member : *members) scalars(member.node, text, out);
  } else if (const auto* items = node.list()) {
    for (const json::Node& item : *items) scalars(item, text, out);
  } else {
    const std::size_t end = node.text() != nullptr ? node.begin + node.text()->size() + 2
                                                   : node.begin + node.spelling(text).size();
    out.push_back({node.begin, end});
  }
}

/// Every scalar of `text` replaced in turn by each of `bad`; how many messages that made.
template <class Parse>
int refuse_all(std::string_view text, Parse parse, std::span<const std::string_view> bad) {
  int count = 0;
  const auto document = json::parse(text);
  EXPECT_TRUE(document.ok());
  std::vector<Place> places;
  scalars(document->root, text, places);
  for (const Place& place : places) {
    for (const std::string_view by : bad) {
      std::string mutated(text);
      mutated.replace(place.begin, place.end - place.begin, by);
      const auto read = parse(mutated);
      EXPECT_TRUE(!read.ok() || !read->messages.at(0).result.ok())
          << mutated.substr(place.begin - std::min<std::size_t>(place.begin, 30), 60);
      ++count;
    }
  }
  return count;
}

constexpr std::array<std::string_view, 8> kNowhereRight = {"null",  "true", "{}",        "[]",
                                                           "1e999", "NaN",  "-Infinity", "[1, 2]"};

TEST(MutatedMessages, AreRefusedWhereverTheyAreWrong) {
  const auto objects = [](std::string_view text) {
    return parse_collision_objects(text, Retain::no);
  };
  const auto constraints = [](std::string_view text) {
    return parse_planning_constraints(text, Retain::no);
  };
  EXPECT_GE(refuse_all(kBox, objects, kNowhereRight), 100);
  EXPECT_GE(refuse_all(kEachShape, objects, kNowhereRight), 100);
  EXPECT_GE(refuse_all(kEachConstraint, constraints, kNowhereRight), 100);
}

TEST(MutatedMessages, ThatAreCutAreRefusedAtEachByte) {
  for (const std::string_view text : {kBox, kEachShape}) {
    for (std::size_t size = 1; size < text.size(); ++size)
      EXPECT_FALSE(parse_collision_objects(text.substr(0, size), Retain::no).ok()) << size;
  }
}

}  // namespace
}  // namespace drover::publish
