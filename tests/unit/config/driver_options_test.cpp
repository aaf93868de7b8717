// Each option of each driver of the registry, as somebody writes it wrong: it is told where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "drover/registry.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::ContainsRegex;

std::string number_text(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// The problems of a device of this driver, one of whose options is this text.
std::string told_of(const DriverEntry& entry, std::string_view option, const std::string& value) {
  return problems(with("\"gnss\": {\"driver\"", "\"x\": {\"driver\": \"" + std::string(entry.name) +
                                                    "\", \"link\": \"can0\", \"options\": {\"" +
                                                    std::string(option) + "\": " + value +
                                                    "}}, \"gnss\": {\"driver\""));
}

class DriverOptions : public testing::TestWithParam<const DriverEntry*> {
 protected:
  /// File, line, column and path, and what would be right.
  void expect_to_be_refused(const OptionSpec& spec, const std::string& value,
                            const std::string& what) {
    EXPECT_THAT(told_of(*GetParam(), spec.name, value),
                ContainsRegex("f:7:[0-9]+: devices.x.options." + std::string(spec.name) +
                              ": [^\n]*" + what))
        << value;
  }
};

TEST_P(DriverOptions, AreRefusedByPlaceAndPathWhenTheyAreOfAWrongType) {
  for (const OptionSpec& spec : GetParam()->options) {
    const bool is_text = std::holds_alternative<std::string>(spec.default_value);
    for (const std::string value : {"{}", "[1]", "null", is_text ? "1" : "\"neither\""})
      expect_to_be_refused(spec, value, "is expected");
    if (std::holds_alternative<bool>(spec.default_value)) expect_to_be_refused(spec, "1", "true");
    if (spec.integer) expect_to_be_refused(spec, number_text(spec.min + 0.5), "a whole number");
  }
}

TEST_P(DriverOptions, AreRefusedWithWhatIsAllowedWhenTheyAreTooLargeOrTooSmall) {
  for (const OptionSpec& spec : GetParam()->options) {
    if (!spec.choices.empty()) expect_to_be_refused(spec, "\"neither\"", "is not one of: ");
    if (!std::holds_alternative<double>(spec.default_value)) continue;
    for (const double value : {spec.max + 1, spec.min - 1})
      expect_to_be_refused(spec, number_text(value), "must be between [^\n]* and ");
  }
}

std::vector<const DriverEntry*> all_entries() {
  std::vector<const DriverEntry*> all;
  for (const DriverEntry& entry : driver_registry()) all.push_back(&entry);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, DriverOptions, testing::ValuesIn(all_entries()),
                         [](const auto& info) { return std::string(info.param->name); });

}  // namespace
}  // namespace drover::config
