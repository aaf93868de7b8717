#include "cli/option_texts.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace drover::cli {

namespace {

OptionValue taken_as(const OptionSpec& spec, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return WrongUsage("option " + std::string(spec.name) + ": \"" + text + "\" " + why);
  };
  if (std::holds_alternative<bool>(spec.default_value)) {
    if (text != "true" && text != "false") throw wrong("is neither true nor false");
    return text == "true";
  }
  if (std::holds_alternative<std::string>(spec.default_value)) {
    const auto& choices = spec.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
      throw wrong("is none of its choices");
    return text;
  }
  double value = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) throw wrong("is no number");
  if (spec.integer && value != std::floor(value)) throw wrong("is no whole number");
  if (spec.min < spec.max && (value < spec.min || value > spec.max)) throw wrong("is out of range");
  return value;
}

}  // namespace

Options options_from(std::span<const OptionSpec> specs, const std::vector<std::string>& texts) {
  Options options(specs);
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    const auto name = text.substr(0, equals);
    const auto spec = std::find_if(specs.begin(), specs.end(),
                                   [&](const OptionSpec& each) { return each.name == name; });
    if (spec == specs.end()) throw WrongUsage("the driver has no option \"" + name + "\"");
    if (equals == std::string::npos) throw WrongUsage("option " + name + ": no =VALUE");
    options.set(name, taken_as(*spec, text.substr(equals + 1)));
  }
  std::string missing;
  for (const auto& spec : specs)
    if (!options.has(spec.name)) missing += " --option " + std::string(spec.name) + "=VALUE";
  if (!missing.empty()) throw WrongUsage("the driver needs" + missing);
  return options;
}

}  // namespace drover::cli
