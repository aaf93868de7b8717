// Characters that are no text: they move a terminal's cursor, or show other words than are written.
#pragma once

#include <string>
#include <string_view>

namespace drover::text {

/// A character of UTF-8 that shows as another line, as nothing, or turns the text around it: C0 and
/// C1 controls, DEL, U+2028, U+2029 and the marks of bidirectional text (U+061C, U+200E, U+200F,
/// U+202A to U+202E, U+2066 to U+2069).
bool is_control(std::string_view character);
bool has_control(std::string_view text);

/// Each of them as '?': so a text of others is shown to people. What is no UTF-8 stays.
std::string harmless(std::string_view text);

}  // namespace drover::text
