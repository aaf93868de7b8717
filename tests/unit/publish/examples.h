// The protocol document's own example messages, as they stand there, comments included, and what
// such a message has in it.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "json/located_json.h"

namespace drover::publish {

inline std::string example(const std::string& name) {
  std::ifstream file(std::string(DROVER_SOURCE_DIR) + "/tests/unit/publish/protocol_examples/" +
                     name + ".json");
  return {std::istreambuf_iterator<char>(file), {}};
}

inline json::Document document_of(const std::string& text) {
  auto result = json::parse(text);
  EXPECT_TRUE(result.ok()) << result.error().text() << "\n" << text;
  return result.ok() ? std::move(result.value()) : json::Document{};
}

}  // namespace drover::publish
