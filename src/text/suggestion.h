// What somebody most likely meant who wrote a word that does not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drover::text {

/// The candidate that `word` most likely was meant to be; empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);
/// "did you mean ...?"; empty when no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace drover::text
