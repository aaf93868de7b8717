// What `drover learned show` prints.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// A table of what `{"cmd":"learned"}` answers.
std::string show_learned(const json::Node& answer);

}  // namespace drover::cli
