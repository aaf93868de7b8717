#include "cli/unheard_drives.h"

#include <string_view>

#include "cli/layout.h"

namespace drover::cli {

namespace {

bool has_no_power(const json::Node& status) {
  if (yes(at(at(at(status, "lines"), "estop"), "active"))) return true;
  const auto* relay = at(status, "outputs").find("enable_relay");
  return relay != nullptr && !yes(*relay);
}

bool is_unheard(const json::Node& drive) {
  return text(at(drive, "health")) != "fresh";
}

}  // namespace

std::string unheard_drives(const json::Node& status) {
  if (has_no_power(status)) return {};
  std::string names;
  const auto add = [&](std::string_view name) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  };
  const auto& axes = at(status, "axes");
  for (std::size_t i = 0; i < count(axes); ++i)
    if (is_unheard(entry(axes, i))) add(text(at(entry(axes, i), "joint")));
  const auto& base = at(status, "base");
  if (base.object() != nullptr && is_unheard(base)) add("the base");
  return names;
}

}  // namespace drover::cli
