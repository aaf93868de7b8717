// The first form of the configuration had a section for each kind of device: buses, drives, base,
// gnss, imu, battery, lines. What stands in them, in the form of today.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/load.h"
#include "json/located_json.h"

namespace drover::config {

struct OldSections {
  std::vector<Problem> problems;  ///< each of them, at its place; empty: there are none
  std::string sections;           ///< the same in today's form, to be put in their stead
};

bool is_old_section(std::string_view key);

/// With the same meaning; comments are not carried over, and a mistake stays one.
OldSections find_old_sections(const json::Node& root);

/// The whole text with today's sections: of a recording that is older. As it is when there is none
/// of the old ones, or when it is no JSON.
std::string in_todays_form(std::string_view text);

}  // namespace drover::config
