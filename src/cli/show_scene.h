// droverd's answers about the planning scene as text for people.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// Of scene_list: a line an object, a line a set of constraints; first what is wrong with what was
/// stored, and the way out.
std::string show_scene(const json::Node& answer);
/// Of scene_show: a line a shape, a line a constraint.
std::string show_scene_entry(const json::Node& answer);
}  // namespace drover::cli
