// A driver's options: declared as a table, given as plain values, read once at start-up.
#pragma once

#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

namespace drover {

using OptionValue = std::variant<bool, double, std::string>;

/// One line of a driver's option table. The configuration reader checks against it (unknown keys,
/// types, ranges, choices) and the JSON schema is generated from it.
struct OptionSpec {
  std::string_view name;
  OptionValue default_value;
  bool required = false;
  double min = 0;  ///< numbers only, inclusive; used when min < max
  double max = 0;
  bool integer = false;
  std::span<const std::string_view> choices = {};  ///< texts only; empty: any
  std::string_view text;                           ///< meaning, with unit and default's reason
};

/// Values that were checked against the table, defaults filled in.
class Options {
 public:
  Options() = default;
  /// Starts from the defaults of `specs`; required options without a value stay unset.
  explicit Options(std::span<const OptionSpec> specs) {
    for (const auto& spec : specs)
      if (!spec.required) values_[std::string(spec.name)] = spec.default_value;
  }
  Options& set(std::string_view name, OptionValue value) {
    values_[std::string(name)] = std::move(value);
    return *this;
  }
  bool has(std::string_view name) const { return values_.count(std::string(name)) != 0; }
  double number(std::string_view name) const { return get<double>(name); }
  bool flag(std::string_view name) const { return get<bool>(name); }
  const std::string& text(std::string_view name) const { return get<std::string>(name); }
  const std::map<std::string, OptionValue>& all() const { return values_; }

 private:
  template <class T>
  const T& get(std::string_view name) const {
    const auto it = values_.find(std::string(name));
    if (it == values_.end()) throw std::runtime_error("option missing: " + std::string(name));
    const T* value = std::get_if<T>(&it->second);
    if (value == nullptr) throw std::runtime_error("option has a wrong type: " + std::string(name));
    return *value;
  }
  std::map<std::string, OptionValue> values_;
};

}  // namespace drover
