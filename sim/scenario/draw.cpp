#include "sim/scenario/draw.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace drover::sim {
namespace {

/// FNV-1a: the same number on every machine.
std::uint64_t number_of(const std::string& place) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : place) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}

/// The last step of SplitMix64: neighbouring numbers in, unlike ones out.
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
  return bits ^ (bits >> 31U);
}

double drawn(const nlohmann::json& range, const std::string& place, std::uint64_t seed) {
  constexpr double kSteps_per_unit = 1e6;
  const auto& from = range.at("from");
  const auto& to = range.at("to");
  if (!from.is_number() || !to.is_number() || !(from.get<double>() < to.get<double>()))
    throw std::runtime_error(place + ": must go from a number to a higher one");
  const double share =
      std::ldexp(static_cast<double>(mixed(mixed(seed) ^ number_of(place)) >> 11U), -53);
  const double value = from.get<double>() + share * (to.get<double>() - from.get<double>());
  return std::round(value * kSteps_per_unit) / kSteps_per_unit;
}

void draw(nlohmann::json& value, const std::string& place, std::uint64_t seed) {
  if (value.is_object() && value.size() == 2 && value.contains("from") && value.contains("to")) {
    value = drawn(value, place, seed);
  } else if (value.is_object()) {
    for (auto& [key, member] : value.items()) draw(member, place + "." + key, seed);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      draw(value[i], place + "[" + std::to_string(i) + "]", seed);
  }
}

}  // namespace

void draw_mission(nlohmann::json& document, std::uint64_t seed) {
  if (document.is_object() && document.contains("mission"))
    draw(document["mission"], "mission", seed);
}

}  // namespace drover::sim
