// A scenario's document: the file and, below it, the robot that it names.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace drover::sim {

/// Reads FILE. When it has a member "robot" (the path of another document, relative to FILE), the
/// result is that document with FILE's own members merged over it (RFC 7396: objects member by
/// member, null removes, everything else replaces; and see change_document). "gateway" stays a
/// change, with its nulls. "world" becomes relative to FILE's folder. Throws std::runtime_error
/// naming the file.
nlohmann::json load_scenario_document(const std::string& file);

/// Merges `change` into a robot's or a gateway's document. Its "drives" may be an object: what it
/// says of a joint, or of a drive's own name, is merged into that drive, {"front_left": {"options":
/// {...}}}. Throws std::runtime_error when there is no such drive.
void change_document(nlohmann::json& document, nlohmann::json change);

/// A battery's register map: the file `map` below `folder`, or one of a clone's config/maps when
/// `folder` is in a clone, else what a configuration in `folder` means by it. Empty: none.
std::string map_file(const std::string& map, const std::filesystem::path& folder);

/// Why there is no such map, installed ones looked through too; empty: there is one.
std::string why_no_map(const std::string& map, const std::filesystem::path& folder);

/// The path of the robot that FILE names, empty when it names none. Throws as above.
std::string robot_file_of(const std::string& file);

}  // namespace drover::sim
