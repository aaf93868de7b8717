// droverd's answers about the zones as text for people.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// Of zone_list: a line a zone, and what is to be known of it.
std::string show_zones(const json::Node& answer);
/// Of zone_list after a zone was deleted: that no keep-in is left. Empty while there is one.
std::string bounds_nothing(const json::Node& answer);
/// Of zone_import: what is stored now.
std::string show_imported(const json::Node& answer);

}  // namespace drover::cli
