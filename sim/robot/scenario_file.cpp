#include "sim/robot/scenario_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "config/register_map.h"
#include "sim/robot/json_reader.h"

namespace drover::sim {
namespace {

namespace fs = std::filesystem;

nlohmann::json read_object(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + ": cannot open");
  std::ostringstream text;
  text << stream.rdbuf();
  try {
    auto document = parse_json(text.str());
    if (!document.is_object()) throw std::runtime_error("must be an object");
    return document;
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

/// As written, relative to the scenario's folder; empty: none.
fs::path robot_reference(const nlohmann::json& document, const std::string& file) {
  const auto robot = document.find("robot");
  if (robot == document.end()) return {};
  if (!robot->is_string()) throw std::runtime_error(file + ": robot: must be the path of a file");
  return robot->get<std::string>();
}

fs::path resolved(const std::string& file, const fs::path& reference) {
  return (fs::path(file).parent_path() / reference).lexically_normal();
}

bool is_called(const nlohmann::json& drive, const std::string& name) {
  if (drive.value("joint", "") == name || drive.value("name", "") == name) return true;
  const auto joints = drive.find("joints");
  return joints != drive.end() && joints->is_array() &&
         std::find(joints->begin(), joints->end(), name) != joints->end();
}

void change_drive(nlohmann::json& document, const std::string& name, const nlohmann::json& change) {
  for (auto& drive : document["drives"]) {
    if (!is_called(drive, name)) continue;
    drive.merge_patch(change);
    return;
  }
  throw std::runtime_error("drives." + name + ": there is no drive of this joint to change");
}

/// Two changes one after the other as one. `null` is kept: it removes what the change is made to.
void add_change(nlohmann::json& into, const nlohmann::json& change) {
  if (!into.is_object() || !change.is_object()) {
    into = change;
    return;
  }
  for (const auto& [key, value] : change.items()) add_change(into[key], value);
}

}  // namespace

std::string map_file(const std::string& map, const fs::path& folder) {
  const auto beside = fs::absolute(folder) / map;
  if (fs::exists(beside)) return beside.lexically_normal().string();
  for (auto above = beside.parent_path(); above.has_relative_path(); above = above.parent_path()) {
    const auto of_the_clone = above / "config" / "maps" / map;
    if (fs::exists(of_the_clone)) return of_the_clone.string();
  }
  if (const auto found = config::find_register_map(map, folder.string()); fs::exists(found))
    return fs::absolute(found).string();
  return "";
}

std::string why_no_map(const std::string& map, const fs::path& folder) {
  const auto missing = config::missing_register_map(map, folder.string());
  return missing.message.empty() ? "" : missing.text();
}

void change_document(nlohmann::json& document, nlohmann::json change) {
  if (const auto drives = change.find("drives"); drives != change.end() && drives->is_object()) {
    for (const auto& [name, member] : drives->items()) change_drive(document, name, member);
    change.erase(drives);
  }
  document.merge_patch(change);
}

nlohmann::json load_scenario_document(const std::string& file) {
  auto scenario = read_object(file);
  const auto reference = robot_reference(scenario, file);
  if (reference.empty()) return scenario;
  scenario.erase("robot");
  const auto robot_file = resolved(file, reference).string();
  auto merged = read_object(robot_file);
  if (merged.contains("robot"))
    throw std::runtime_error(robot_file + ": robot: a robot cannot name another robot");
  if (const auto world = merged.find("world"); world != merged.end() && world->is_string())
    *world = (reference.parent_path() / world->get<std::string>()).string();
  const auto find_map = [&](nlohmann::json& device) {
    if (!device.is_object() || !device.contains("map") || !device["map"].is_string()) return;
    // One of the installed maps has no folder.
    const auto found = map_file(device["map"], fs::path(robot_file).parent_path());
    if (!found.empty()) device["map"] = found;
  };
  if (merged.contains("battery")) find_map(merged["battery"]);
  if (merged.contains("more") && merged["more"].is_object())
    for (auto& device : merged["more"]) find_map(device);
  // What it removes it removes from the gateway's file.
  if (const auto gateway = scenario.find("gateway"); gateway != scenario.end()) {
    add_change(merged["gateway"], *gateway);
    scenario.erase(gateway);
  }
  try {
    change_document(merged, std::move(scenario));
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  return merged;
}

std::string robot_file_of(const std::string& file) {
  const auto reference = robot_reference(read_object(file), file);
  return reference.empty() ? "" : resolved(file, reference).string();
}

}  // namespace drover::sim
