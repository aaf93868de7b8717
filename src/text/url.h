// AimRT's URL encoding, in which MQTT topics are written.
#pragma once

#include <string>
#include <string_view>

namespace drover::text {

/// Letters, digits and "-_.~" stay, a space is '+', every other byte is %XX in upper case.
std::string url_encoded(std::string_view text);

}  // namespace drover::text
