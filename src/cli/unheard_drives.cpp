#include "cli/unheard_drives.h"

#include <string_view>

namespace drover::cli {

namespace {

bool is_true(const json::Node* value) {
  return value != nullptr && value->boolean() != nullptr && *value->boolean();
}

std::string text_of(const json::Node& object, std::string_view key) {
  const auto* value = object.find(key);
  return value != nullptr && value->text() != nullptr ? *value->text() : std::string();
}

bool has_no_power(const json::Node& status) {
  const auto* lines = status.find("lines");
  const auto* estop = lines == nullptr ? nullptr : lines->find("estop");
  if (estop != nullptr && is_true(estop->find("active"))) return true;
  const auto* outputs = status.find("outputs");
  const auto* relay = outputs == nullptr ? nullptr : outputs->find("enable_relay");
  return relay != nullptr && !is_true(relay);
}

bool is_unheard(const json::Node& drive) {
  return text_of(drive, "health") != "fresh";
}

}  // namespace

std::string unheard_drives(const json::Node& status) {
  if (has_no_power(status)) return {};
  std::string names;
  const auto add = [&](std::string_view name) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  };
  const auto* axes = status.find("axes");
  if (axes != nullptr && axes->list() != nullptr) {
    for (const auto& axis : *axes->list())
      if (is_unheard(axis)) add(text_of(axis, "joint"));
  }
  const auto* base = status.find("base");
  if (base != nullptr && base->object() != nullptr && is_unheard(*base)) add("the base");
  return names;
}

}  // namespace drover::cli
