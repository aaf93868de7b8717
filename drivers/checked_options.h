// A driver's options against its own table: who makes a driver without the configuration's reader,
// a test or a tool, is told the same.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drover/options.h"
#include "drover/time.h"

namespace drover {

/// All of the table is looked at as soon as it is made, whatever is read of it then. Every refusal
/// is a std::runtime_error that begins with the option's name.
class CheckedOptions final {
 public:
  CheckedOptions(const Options& options, std::span<const OptionSpec> specs);

  /// Inside the range of its line in the table, and a number.
  double number(std::string_view name) const { return options_.number(known(name)); }
  Duration seconds(std::string_view name) const { return from_s(number(name)); }
  bool flag(std::string_view name) const { return options_.flag(known(name)); }
  /// One of the choices of its line, if there are any.
  const std::string& text(std::string_view name) const { return options_.text(known(name)); }

 private:
  /// The name itself, if the table has it.
  std::string_view known(std::string_view name) const;

  const Options& options_;
  std::span<const OptionSpec> specs_;
};

/// The same options, once they were looked at.
inline const Options& all_checked(const Options& options, std::span<const OptionSpec> specs) {
  static_cast<void>(CheckedOptions(options, specs));
  return options;
}

}  // namespace drover
