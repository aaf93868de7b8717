// UTF-8 as RFC 3629 has it.
#pragma once

#include <cstddef>
#include <string_view>

namespace drover::text {

/// Length of the character at the front, 0 when there is none: shortest form, no surrogates,
/// nothing above U+10FFFF.
std::size_t character_bytes(std::string_view text);

}  // namespace drover::text
