// Numbers in sentences for a person.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drover::text {

/// "0.5", "200": ten digits at most, without trailing zeros.
std::string number_text(double value);
/// By a printf form of one number: "%.2f m" makes "0.50 m".
std::string formed(const char* form, double value);
/// "1 hole", "2 holes".
std::string counted(std::size_t n, std::string_view one, std::string_view many);

}  // namespace drover::text
