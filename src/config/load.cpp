#include "config/load.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "config/reader.h"

namespace drover::config {

namespace {

constexpr std::size_t kMaxBuses = 4;

template <class T, class Get>
std::vector<std::string> collect(const std::vector<T>& items, Get get) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(get(item));
  return names;
}

/// Where `path` like "drives[1].joint" stands in the document.
const json::Node& place(const json::Node& root, std::string_view list, std::size_t index,
                        std::string_view key) {
  const auto* items = root.find(list);
  if (items == nullptr || items->list() == nullptr || index >= items->list()->size()) return root;
  const auto& item = (*items->list())[index];
  const auto* member = item.find(key);
  return member != nullptr ? *member : item;
}

class Checks final {
 public:
  Checks(const json::Node& root, Loaded& loaded) : root_(root), loaded_(loaded) {}

  void run(const BaseNames& base) {
    counts();
    unique_names();
    drives_and_buses();
    sides(base);
    limits();
    finish_engine();
  }

 private:
  void add(const json::Node& at, std::string path, std::string message, std::string hint = {}) {
    loaded_.problems.push_back(
        {at.line, at.column, std::move(path), std::move(message), std::move(hint)});
  }
  static std::string item(std::string_view list, std::size_t index, std::string_view key) {
    return std::string(list) + "[" + std::to_string(index) + "]." + std::string(key);
  }

  void counts() {
    if (loaded_.config.buses.size() > kMaxBuses)
      add(root_, "buses", "has more than " + std::to_string(kMaxBuses) + " entries");
    if (loaded_.config.drives.size() > kMaxAxes)
      add(root_, "drives", "has more than " + std::to_string(kMaxAxes) + " entries");
    if (loaded_.config.drives.empty()) add(root_, "drives", "is empty: nothing could move");
  }

  void unique(std::string_view list, std::string_view key, const std::vector<std::string>& names) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto [it, inserted] = first.emplace(names[i], i);
      if (!inserted)
        add(place(root_, list, i, key), item(list, i, key),
            "\"" + names[i] + "\" is used by " + item(list, it->second, key) + " already");
    }
  }
  void unique_names() {
    const auto& c = loaded_.config;
    unique("buses", "name", collect(c.buses, [](const auto& b) { return b.name; }));
    unique("buses", "interface", collect(c.buses, [](const auto& b) { return b.interface; }));
    unique("drives", "joint", collect(c.drives, [](const auto& d) { return d.joint; }));
  }

  void drives_and_buses() {
    auto& c = loaded_.config;
    const auto buses = collect(c.buses, [](const auto& b) { return b.name; });
    std::map<std::string, std::size_t> addresses;
    for (std::size_t i = 0; i < c.drives.size(); ++i) {
      auto& drive = c.drives[i];
      const auto bus = std::find(buses.begin(), buses.end(), drive.bus);
      if (bus == buses.end()) {
        const auto best = nearest(drive.bus, buses);
        add(place(root_, "drives", i, "bus"), item("drives", i, "bus"),
            "there is no bus named \"" + drive.bus + "\"",
            best.empty() ? "" : "did you mean \"" + best + "\"?");
        continue;
      }
      drive.bus_index = static_cast<std::size_t>(bus - buses.begin());
      if (!drive.options.has("node")) continue;
      const auto address =
          drive.bus + " " + drive.driver + " node " + number_text(drive.options.number("node"));
      const auto [it, inserted] = addresses.emplace(address, i);
      if (!inserted)
        add(place(root_, "drives", i, "options"), item("drives", i, "options.node"),
            "two drives have one address (" + address + "): the other is " +
                item("drives", it->second, "options.node"));
    }
  }

  void side(std::string_view key, const std::vector<std::string>& joints,
            FixedVector<AxisId, 8>& into) {
    const auto* base = root_.find("base");
    const auto* node = base != nullptr ? base->find(key) : nullptr;
    const auto& at = node != nullptr ? *node : root_;
    const auto path = "base." + std::string(key);
    const auto known = collect(loaded_.config.drives, [](const auto& d) { return d.joint; });
    for (const auto& joint : joints) {
      const auto it = std::find(known.begin(), known.end(), joint);
      if (it == known.end()) {
        const auto best = nearest(joint, known);
        add(at, path, "no drive has the joint \"" + joint + "\"",
            best.empty() ? "" : "did you mean \"" + best + "\"?");
      } else if (!into.push_back(static_cast<AxisId>(it - known.begin()))) {
        add(at, path, "has more than 8 joints");
      }
    }
    if (joints.empty() && node != nullptr) add(at, path, "is empty");
  }
  void sides(const BaseNames& base) {
    auto& engine = loaded_.config.engine;
    side("left", base.left, engine.base.left);
    side("right", base.right, engine.base.right);
    for (const auto left : engine.base.left)
      for (const auto right : engine.base.right)
        if (left == right)
          add(*root_.find("base"), "base", "the joint \"" + loaded_.config.drives[left].joint +
                                               "\" is on both sides");
  }

  void limits() {
    const auto& limits = loaded_.config.engine.limits;
    if (limits.min_speed_mps > limits.max_speed_mps)
      add(root_.find("limits") != nullptr ? *root_.find("limits") : root_, "limits.min_speed_mps",
          "is above limits.max_speed_mps");
  }

  void finish_engine() {
    auto& c = loaded_.config;
    c.engine.tick_Hz = c.control.tick_Hz;
    // The driver places each byte in time by the pace at which the line is really opened.
    if (c.gnss.options.has("baud"))
      c.gnss.options.set("baud", static_cast<double>(c.gnss.baud));
    c.engine.health.guard_required = c.guard.required;
    for (const auto& drive : c.drives) (void)c.engine.joints.push_back(Name(drive.joint));
    for (std::size_t i = 0; i < kLineCount; ++i)
      c.engine.line_configured[i] = c.lines.line[i].configured;
  }

  const json::Node& root_;
  Loaded& loaded_;
};

}  // namespace

std::string Problem::text(std::string_view file) const {
  std::string out(file);
  if (line > 0) out += ":" + std::to_string(line) + ":" + std::to_string(column);
  out += ": ";
  if (!path.empty()) out += path + ": ";
  out += message;
  if (!suggestion.empty()) out += " (" + suggestion + ")";
  return out;
}

Loaded load_text(std::string_view text) {
  Loaded loaded;
  const auto document = json::parse(text);
  if (!document) {
    const auto& error = document.error();
    loaded.problems.push_back({error.line, error.column, error.path, error.message, ""});
    return loaded;
  }
  const auto& root = document->root;
  if (root.object() == nullptr) {
    loaded.problems.push_back({root.line, root.column, "", "an object is expected", ""});
    return loaded;
  }
  BaseNames base;
  base.base = &loaded.config.engine.base;
  Reader reader(root, "", loaded.problems);
  visit(reader, loaded.config, base);
  reader.finish();
  Checks(root, loaded).run(base);
  std::stable_sort(loaded.problems.begin(), loaded.problems.end(),
                   [](const Problem& a, const Problem& b) {
                     return std::pair(a.line, a.column) < std::pair(b.line, b.column);
                   });
  return loaded;
}

Loaded load_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    Loaded loaded;
    loaded.problems.push_back({0, 0, "", "cannot be read", ""});
    return loaded;
  }
  return load_text(text.str());
}

}  // namespace drover::config
