// Numbers in sentences for a person.
#pragma once

#include <string>

namespace drover::text {

/// "0.5", "200": ten digits at most, without trailing zeros.
std::string number_text(double value);

}  // namespace drover::text
