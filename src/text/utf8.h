// UTF-8 as RFC 3629 has it.
#pragma once

#include <cstddef>
#include <string_view>

namespace drover::text {

/// Length of the character at the front, 0 when there is none: shortest form, no surrogates,
/// nothing above U+10FFFF.
std::size_t character_bytes(std::string_view text);

/// At most so many of its first bytes, whole characters.
std::string_view beginning(std::string_view text, std::size_t most_bytes);

}  // namespace drover::text
