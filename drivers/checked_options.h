// A driver's options against its own table: who makes a driver without the configuration's reader,
// a test or a tool, is told the same.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drover/options.h"
#include "drover/time.h"

namespace drover {

/// Every refusal is a std::runtime_error that begins with the option's name.
class CheckedOptions final {
 public:
  CheckedOptions(const Options& options, std::span<const OptionSpec> specs)
      : options_(options), specs_(specs) {}

  /// Inside the range of its line in the table, and a number.
  double number(std::string_view name) const;
  Duration seconds(std::string_view name) const { return from_s(number(name)); }
  /// One of the choices of its line, if there are any.
  const std::string& text(std::string_view name) const;

 private:
  const OptionSpec& spec_of(std::string_view name) const;

  const Options& options_;
  std::span<const OptionSpec> specs_;
};

}  // namespace drover
