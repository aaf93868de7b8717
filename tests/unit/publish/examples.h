// The protocol document's own example messages, as they stand there, comments included.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace drover::publish {

inline std::string example(const std::string& name) {
  std::ifstream file(std::string(DROVER_SOURCE_DIR) + "/tests/unit/publish/protocol_examples/" +
                     name + ".json");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace drover::publish
