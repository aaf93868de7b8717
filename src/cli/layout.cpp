#include "cli/layout.h"

#include <cmath>
#include <cstdio>
#include <ctime>

#include "text/control.h"
#include "text/number.h"

namespace drover::cli {

using json::Node;

const Node& at(const Node& node, std::string_view key) {
  static const Node kNothing;
  const auto* found = node.find(key);
  return found != nullptr ? *found : kNothing;
}

std::string text(const Node& node) {
  if (const auto* value = node.text()) return text::harmless(*value);
  if (const auto* value = node.boolean()) return *value ? "yes" : "no";
  return "";
}

std::string quantity(const Node& node, const char* format) {
  const auto value = node.number();
  return value ? text::formed(format, *value) : "-";
}

std::string distance(const json::Node& node) {
  constexpr double kFar_m = 10'000;
  const auto value_m = node.number();
  if (!value_m || std::abs(*value_m) < kFar_m) return quantity(node, "%.2f m");
  return text::formed("%.1f km", *value_m / 1e3);
}

std::string labelled(std::string_view label, const Node& node, const char* format) {
  return std::string(label) + " " + quantity(node, format);
}

std::string date(const Node& unix_s, const char* format) {
  const auto value_s = unix_s.number();
  if (!value_s) return "";
  const auto seconds = static_cast<std::time_t>(*value_s);
  std::tm utc{};
  char text[64];
  if (::gmtime_r(&seconds, &utc) == nullptr || std::strftime(text, sizeof text, format, &utc) == 0)
    return "";
  return text;
}

bool yes(const Node& node) {
  return node.boolean() != nullptr && *node.boolean();
}

double value_of(const Node& node) {
  return node.number().value_or(0);
}

std::size_t count(const Node& list) {
  return list.list() != nullptr ? list.list()->size() : 0;
}

const Node& entry(const Node& list, std::size_t i) {
  static const Node kNothing;
  return i < count(list) ? (*list.list())[i] : kNothing;
}

void line(std::string& out, std::string_view label, const std::string& value) {
  char head[32];
  std::snprintf(head, sizeof head, "%-9.*s ", static_cast<int>(label.size()), label.data());
  out += head + value + "\n";
}

std::string padded(std::string value, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : value) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  if (characters < width) value.append(width - characters, ' ');
  return value;
}

}  // namespace drover::cli
