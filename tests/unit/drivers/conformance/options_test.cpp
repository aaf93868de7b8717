// What each driver of the registry and its twin take of their options, whoever makes them: nothing
// that their own tables do not allow.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// As a refusal of the configuration writes it.
std::string between(const OptionSpec& spec) {
  std::ostringstream text;
  text.precision(10);
  text << "between " << spec.min << " and " << spec.max;
  return text.str();
}

std::vector<OptionValue> of_wrong_types(const OptionSpec& spec) {
  if (std::holds_alternative<double>(spec.default_value)) return {true, std::string("1")};
  if (std::holds_alternative<bool>(spec.default_value)) return {1.0, std::string("true")};
  return {1.0, true};
}

std::vector<double> out_of(const OptionSpec& spec) {
  return {spec.max + 1,
          spec.min - 1,
          std::nextafter(spec.max, kInfinity),
          std::nextafter(spec.min, -kInfinity),
          kInfinity,
          -kInfinity,
          std::numeric_limits<double>::quiet_NaN()};
}

using Maker = std::function<void(const Options&)>;

/// What is said of this one value; empty when it is taken.
std::string refusal(const Maker& make, Options options, const OptionSpec& spec,
                    const OptionValue& value) {
  options.set(spec.name, value);
  try {
    make(options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// Each option of the table in turn, all others as they may be.
void expect_to_be_refused(const Maker& make, const Options& good,
                          std::span<const OptionSpec> table) {
  make(good);
  for (const OptionSpec& spec : table) {
    SCOPED_TRACE(spec.name);
    const std::string name = std::string(spec.name) + " ";
    for (const auto& value : of_wrong_types(spec))
      EXPECT_THAT(refusal(make, good, spec, value), StartsWith(name + "must be "));
    if (!spec.choices.empty()) {
      EXPECT_THAT(refusal(make, good, spec, std::string("neither")), StartsWith(name + "must be "));
      continue;
    }
    if (!std::holds_alternative<double>(spec.default_value)) continue;
    EXPECT_LT(spec.min, spec.max) << "a number has a range";
    for (const double value : out_of(spec))
      EXPECT_THAT(refusal(make, good, spec, value), StartsWith(name)) << value;
    EXPECT_THAT(refusal(make, good, spec, spec.max + 1), HasSubstr(between(spec)));
    EXPECT_THAT(refusal(make, good, spec, spec.min - 1), HasSubstr(between(spec)));
    if (spec.integer)
      EXPECT_THAT(refusal(make, good, spec, spec.min + 0.5), StartsWith(name + "must be a whole"));
  }
}

RegisterMap a_map() {
  RegisterMap map;
  map.fields.emplace_back();
  return map;
}

/// Makes the twin, whatever its factory wants to know; empty where there is none.
struct TwinMaker {
  Maker operator()(std::monostate) const { return {}; }
  Maker operator()(MakeRegisterTwin make) const {
    return [make](const Options& options) { (void)make(options, a_map()); };
  }
  template <class Twin>
  Maker operator()(std::unique_ptr<Twin> (*make)(const Options&)) const {
    return [make](const Options& options) { (void)make(options); };
  }
  template <class Twin>
  Maker operator()(std::unique_ptr<Twin> (*make)(const Options&, std::uint64_t)) const {
    return [make](const Options& options) { (void)make(options, 1); };
  }
};

class OptionConformance : public testing::TestWithParam<const DriverEntry*> {
 protected:
  const DriverEntry& entry_ = *GetParam();
};

TEST_P(OptionConformance, RefusesEachOfItsOwnThatIsOfAWrongTypeOrOutOfItsRange) {
  const auto map = a_map();
  expect_to_be_refused([&](const Options& options) { (void)made_of(entry_, options, &map); },
                       example_options(entry_), entry_.options);
}

TEST_P(OptionConformance, HasATwinThatRefusesEachOfItsOwnLikewise) {
  const auto make = std::visit(TwinMaker{}, entry_.make_twin);
  EXPECT_EQ(make == nullptr, entry_.name == "gpio_line") << "lines alone have no twin";
  if (make != nullptr) expect_to_be_refused(make, example_options(entry_), entry_.twin_options);
}

std::vector<const DriverEntry*> all_entries() {
  std::vector<const DriverEntry*> all;
  for (const DriverEntry& entry : driver_registry()) all.push_back(&entry);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, OptionConformance, testing::ValuesIn(all_entries()),
                         [](const auto& info) { return std::string(info.param->name); });

}  // namespace
}  // namespace drover::test
