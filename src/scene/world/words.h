// Numbers and foreign names for the sentences of the scene.
#pragma once

#include <string>
#include <string_view>

namespace drover::scene::words {

/// With so many decimals; never "-0".
std::string number(double value, int decimals);
/// A foreign name in quotation marks: at most 64 bytes, control characters as '?'.
std::string quoted(std::string_view name);

}  // namespace drover::scene::words
