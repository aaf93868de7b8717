// An answer as the tests of the command line write it.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

inline json::Node parsed(std::string_view text) {
  auto document = json::parse(text);
  if (!document) ADD_FAILURE() << document.error().text();
  return document ? document->root : json::Node{};
}

}  // namespace drover::cli
