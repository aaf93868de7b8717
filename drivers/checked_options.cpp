#include "drivers/checked_options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drover {

const OptionSpec& CheckedOptions::spec_of(std::string_view name) const {
  for (const OptionSpec& spec : specs_)
    if (spec.name == name) return spec;
  throw std::runtime_error(std::string(name) + " is no option");
}

double CheckedOptions::number(std::string_view name) const {
  const OptionSpec& spec = spec_of(name);
  const double value = options_.number(name);
  const bool ranged = spec.min < spec.max;
  if (!std::isfinite(value) || (ranged && (value < spec.min || value > spec.max)))
    throw std::runtime_error(std::string(name) + " is out of range");
  return value;
}

const std::string& CheckedOptions::text(std::string_view name) const {
  const auto& choices = spec_of(name).choices;
  const std::string& value = options_.text(name);
  if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end())
    return value;
  std::string all;
  for (const std::string_view choice : choices)
    all += (all.empty() ? "\"" : " or \"") + std::string(choice) + "\"";
  throw std::runtime_error(std::string(name) + " must be " + all);
}

}  // namespace drover
