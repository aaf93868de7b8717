#include "drivers/checked_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace drover {
namespace {

[[noreturn]] void refuse(const OptionSpec& spec, const std::string& why) {
  throw std::runtime_error(std::string(spec.name) + " " + why);
}

std::string text_of(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", number);
  return text.data();
}

void look_at(const OptionSpec& spec, double value) {
  if (!std::isfinite(value)) refuse(spec, "is no number");
  if (spec.min < spec.max && (value < spec.min || value > spec.max))
    refuse(spec, "is " + text_of(value) + ", but must be between " + text_of(spec.min) + " and " +
                     text_of(spec.max));
  if (spec.integer && value != std::floor(value)) refuse(spec, "must be a whole number");
}

void look_at(const OptionSpec& spec, const std::string& value) {
  const auto& choices = spec.choices;
  if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end()) return;
  std::string all;
  for (const std::string_view choice : choices)
    all += (all.empty() ? "\"" : " or \"") + std::string(choice) + "\"";
  refuse(spec, "must be " + all);
}

void look_at(const OptionSpec&, bool) {}

std::string type_of(const OptionValue& value) {
  if (std::holds_alternative<double>(value)) return "a number";
  return std::holds_alternative<bool>(value) ? "true or false" : "a text";
}

}  // namespace

CheckedOptions::CheckedOptions(const Options& options, std::span<const OptionSpec> specs)
    : options_(options), specs_(specs) {
  for (const OptionSpec& spec : specs) {
    const auto given = options.all().find(std::string(spec.name));
    if (given == options.all().end()) refuse(spec, "is missing");
    if (given->second.index() != spec.default_value.index())
      refuse(spec, "must be " + type_of(spec.default_value));
    std::visit([&](const auto& value) { look_at(spec, value); }, given->second);
  }
}

std::string_view CheckedOptions::known(std::string_view name) const {
  for (const OptionSpec& spec : specs_)
    if (spec.name == name) return name;
  throw std::runtime_error(std::string(name) + " is no option");
}

}  // namespace drover
