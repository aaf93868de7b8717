#include "config/old_sections.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "config/config.h"

namespace drover::config {
namespace {

using Json = nlohmann::ordered_json;

struct OldKey {
  std::string_view name;
  std::string_view now;  ///< where its content belongs
};

constexpr std::array kOldKeys{
    OldKey{"buses", "\"links\""},
    OldKey{"drives", "\"devices\""},
    OldKey{"base", "\"groups\""},
    OldKey{"gnss", "\"links\" and \"devices\""},
    OldKey{"imu", "\"links\" and \"devices\""},
    OldKey{"battery", "\"links\" and \"devices\""},
    OldKey{"lines", "\"links\" and \"devices\""},
};

Json json_of(const json::Node& node) {
  if (const auto* members = node.object()) {
    auto object = Json::object();
    for (const auto& member : *members) object[member.key] = json_of(member.node);
    return object;
  }
  if (const auto* items = node.list()) {
    auto list = Json::array();
    for (const auto& item : *items) list.push_back(json_of(item));
    return list;
  }
  return std::visit(
      [](const auto& value) -> Json {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, std::monostate> ||
                      std::is_same_v<T, std::vector<json::Node>> ||
                      std::is_same_v<T, std::vector<json::Member>>) {
          return nullptr;
        } else {
          return value;
        }
      },
      node.value);
}

/// Foreign characters must not steer the terminal that this is printed on.
std::string quoted(const std::string& text) {
  const auto plain = Json(text).dump();
  std::string out;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto c = static_cast<unsigned char>(plain[i]);
    const auto next = i + 1 < plain.size() ? static_cast<unsigned char>(plain[i + 1]) : 0;
    char escape[8];
    if (c == 0x7F) {
      out += "\\u007f";
    } else if (c == 0xC2 && next < 0xA0) {
      std::snprintf(escape, sizeof escape, "\\u00%02x", next);
      out += escape;
      ++i;
    } else {
      out += plain[i];
    }
  }
  return out;
}

std::string line_of(const Json& value) {
  if (value.is_string()) return quoted(value.get<std::string>());
  if (!value.is_structured()) return value.dump();
  std::string out;
  for (const auto& [key, member] : value.items())
    out +=
        (out.empty() ? "" : ", ") + (value.is_object() ? quoted(key) + ": " : "") + line_of(member);
  return value.is_object() ? "{" + out + "}" : "[" + out + "]";
}

/// A table: a line for each entry.
std::string lines_of(std::string_view key, const Json& table) {
  std::string out;
  for (const auto& [name, entry] : table.items())
    out += (out.empty() ? "\n    " : ",\n    ") + quoted(name) + ": " + line_of(entry);
  return "  \"" + std::string(key) + "\": {" + out + "\n  }";
}

/// The value of an old key; null when it is not there.
Json taken(Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) return nullptr;
  Json value = object[key];
  object.erase(key);
  return value;
}

class Translator final {
 public:
  explicit Translator(const json::Node& root) : old_(json_of(root)) {}

  /// Each of the new sections that something belongs to, as `"key": {...}`.
  std::vector<std::string> sections() {
    buses();
    drives();
    serial("gnss", "nmea0183", "/dev/drover/gnss");
    serial("imu", "", "/dev/drover/imu");
    battery();
    lines();
    outputs();
    std::vector<std::string> all;
    for (const auto& [key, table] : {std::pair{"links", &links_}, {"devices", &devices_}})
      if (!table->empty()) all.push_back(lines_of(key, *table));
    if (old_.contains("base")) all.push_back(lines_of("groups", {{"base", base()}}));
    if (!outputs_.is_null()) all.push_back(lines_of("outputs", outputs_));
    return all;
  }

 private:
  /// The name, or a like one when somebody has it.
  static std::string free_name(const Json& table, std::string name) {
    if (name.empty()) name = "unnamed";
    std::string tried = name;
    for (int i = 2; table.contains(tried); ++i) tried = name + "_" + std::to_string(i);
    return tried;
  }
  std::string add_link(const std::string& name, Json link) {
    auto free = free_name(links_, name);
    links_[free] = std::move(link);
    return free;
  }
  /// `rest`: what the section says beside.
  void add_device(const std::string& name, Json device, const Json& rest) {
    if (rest.is_object()) device.update(rest);
    devices_[free_name(devices_, name)] = std::move(device);
  }
  static std::string text_or(const Json& value, const std::string& otherwise) {
    return value.is_string() ? value.get<std::string>() : otherwise;
  }

  void buses() {
    auto list = taken(old_, "buses");
    if (!list.is_array()) return;
    for (auto& bus : list)
      add_link(text_or(taken(bus, "name"), "can0"),
               {{"can", text_or(taken(bus, "interface"), "")}});
  }
  void drives() {
    auto list = taken(old_, "drives");
    if (!list.is_array()) return;
    for (auto& drive : list) {
      const auto name = text_or(taken(drive, "joint"), "");
      Json device{{"driver", taken(drive, "driver")}, {"link", taken(drive, "bus")}};
      add_device(name, std::move(device), drive);
    }
  }
  void serial(const char* key, const char* usual_driver, const char* usual_port) {
    auto section = taken(old_, key);
    if (!section.is_object()) return;
    Json link{{"serial", text_or(taken(section, "port"), usual_port)}};
    if (auto baud = taken(section, "baud"); !baud.is_null()) link["baud"] = std::move(baud);
    Json device{{"driver", text_or(taken(section, "driver"), usual_driver)}};
    device["link"] = add_link(key, std::move(link));
    add_device(key, std::move(device), section);
  }
  void battery() {
    auto section = taken(old_, "battery");
    if (!section.is_object()) return;
    Json link{{"modbus", text_or(taken(section, "port"), "/dev/drover/battery")}};
    for (const char* key : {"baud", "parity"})
      if (auto value = taken(section, key); !value.is_null()) link[key] = std::move(value);
    Json device{{"driver", text_or(taken(section, "driver"), "modbus_bms")}};
    device["link"] = add_link("bms", std::move(link));
    add_device("battery", std::move(device), section);
  }
  void lines() {
    auto section = taken(old_, "lines");
    if (!section.is_object()) return;
    const auto chip = text_or(taken(section, "chip"), "");
    // In the order in which they were numbered, then what was never one.
    for (const auto key : kLineKeys) line(std::string(key), chip, section);
    const Json others = section;
    for (const auto& [key, ignored] : others.items()) line(key, chip, section);
  }
  void line(const std::string& key, const std::string& chip, Json& section) {
    auto line = taken(section, key.c_str());
    if (!line.is_object()) return;
    if (panel_.empty()) panel_ = add_link("panel", {{"gpio", chip}});
    chip_ = chip;
    Json device{{"driver", text_or(taken(line, "driver"), "gpio_line")}, {"link", panel_}};
    device["line"] = taken(line, "line");
    device["is"] = key;
    add_device(key, std::move(device), line);
  }
  void outputs() {
    if (!old_.contains("outputs") || !old_["outputs"].is_object()) return;
    auto section = old_["outputs"];
    const auto chip = taken(section, "chip");
    if (!chip.is_string()) return;  // they have today's form
    const bool shared = !panel_.empty() && chip_ == chip;
    outputs_ = {{"link", shared ? panel_ : add_link("outputs", {{"gpio", chip}})}};
    outputs_.update(section);
  }
  /// As it behaved: who has one wheel on a side may say "differential".
  Json base() {
    Json base{{"kind", "skid_steer"}};
    if (old_["base"].is_object()) base.update(old_["base"]);
    return base;
  }

  Json old_;
  Json links_ = Json::object();
  Json devices_ = Json::object();
  Json outputs_;
  std::string panel_;  ///< name of the link to the lines' chip; empty: there are none
  std::string chip_;
};

}  // namespace

bool is_old_section(std::string_view key) {
  return std::any_of(kOldKeys.begin(), kOldKeys.end(),
                     [key](const OldKey& old) { return old.name == key; });
}

OldSections find_old_sections(const json::Node& root) {
  OldSections old;
  if (root.object() == nullptr) return old;
  const auto tell = [&old](const json::Member& member, const std::string& path,
                           const std::string& now) {
    old.problems.push_back(
        {member.line, member.column, path, "is no key any more", "it belongs to " + now, ""});
  };
  for (const auto& member : *root.object()) {
    for (const auto& key : kOldKeys)
      if (member.key == key.name) tell(member, member.key, std::string(key.now));
    if (member.key != "outputs" || member.node.object() == nullptr) continue;
    for (const auto& inner : *member.node.object())
      if (inner.key == "chip") tell(inner, "outputs.chip", "\"links\"");
  }
  if (old.problems.empty()) return old;
  for (const auto& section : Translator(root).sections())
    old.sections += (old.sections.empty() ? "" : ",\n") + section;
  if (!old.sections.empty())
    for (auto& problem : old.problems) problem.suggestion += ": the new text stands below";
  return old;
}

std::string in_todays_form(std::string_view text) {
  const auto document = json::parse(text);
  if (!document) return std::string(text);
  const auto old = find_old_sections(document->root);
  if (old.problems.empty()) return std::string(text);
  const bool outputs =
      std::any_of(old.problems.begin(), old.problems.end(),
                  [](const Problem& problem) { return problem.path == "outputs.chip"; });
  std::string whole = old.sections;
  for (const auto& member : *document->root.object())
    if (!is_old_section(member.key) && !(outputs && member.key == "outputs"))
      whole += (whole.empty() ? "  " : ",\n  ") + quoted(member.key) + ": " +
               line_of(json_of(member.node));
  return "{\n" + whole + "\n}\n";
}

}  // namespace drover::config
