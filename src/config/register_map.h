// Reads a register map file: every problem at once, each with its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/load.h"
#include "drover/register_map.h"

namespace drover::config {

struct LoadedMap {
  RegisterMap map;   ///< to be used only when there are no problems
  std::string text;  ///< as it was read
  std::vector<Problem> problems;
  std::vector<Problem> warnings;  ///< what it says is good, but hardly meant
};

LoadedMap parse_register_map(std::string_view text);
/// Problems carry the file's name. A file that cannot be read is a problem without a place.
LoadedMap load_register_map(const std::string& path);

/// Where a configuration in `folder` means by `map`: an absolute path, a file below its folder,
/// else one of the installed maps, else, of a program that runs from a build, one of its clone's.
/// The first when none is there.
std::string find_register_map(const std::string& map, const std::string& folder);

/// Why there is no such map, and what there is instead.
struct MissingMap {
  std::string message;  ///< empty: it is there
  std::string hint;
  std::string text() const { return hint.empty() ? message : message + " (" + hint + ")"; }
};
MissingMap missing_register_map(const std::string& map, const std::string& folder);

/// The names of those that come with this program.
std::vector<std::string> known_register_maps();

/// JSON schema (draft 7) of a map file, from the same tables.
std::string register_map_schema_text();

}  // namespace drover::config
