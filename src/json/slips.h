// What is told of a text that is no JSON: by what a person most likely meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drover::json {

/// Of the word at which reading ended, which may be of another language: True, 'text', # comment.
/// `inside` an object or a list. Empty: nothing is known of it.
std::string slip_at(std::string_view text, std::size_t at, bool inside);

/// The parser says what it had hoped for; people look for what they left out.
std::string in_other_words(std::string message);

}  // namespace drover::json
