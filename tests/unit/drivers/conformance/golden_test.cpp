// Every driver that speaks a protocol has golden bytes, and they mean what their files say.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"
#include "unit/drivers/conformance/register_harness.h"

namespace drover::test {
namespace {

class GoldenBytes : public ::testing::TestWithParam<Subject> {};

/// The driver behind one face, whatever its shape.
class AnyDriver {
 public:
  AnyDriver(const DriverEntry& entry, const GoldenFile& file) {
    const Options& options = file.options;
    if (const auto* make = std::get_if<MakeCanDriver>(&entry.make)) can_ = (*make)(options, 0);
    if (const auto* make = std::get_if<MakeByteDriver>(&entry.make)) byte_ = (*make)(options);
    if (const auto* make = std::get_if<MakeRegisterDriver>(&entry.make)) {
      make_registers_ = *make;
      options_ = options;
      map_ = read_map(file.map);
    }
  }
  /// What was exchanged decides which part of its map a register driver gets.
  void prepare(const GoldenCase& one) {
    if (make_registers_ != nullptr)
      registers_ = make_registers_(options_, map_inside(map_, read_exchange(one.bytes)));
  }
  void give(const GoldenCase& one, Time now, DriverOut& out) {
    if (can_ && one.is_frame) can_->on_frame(one.frame, now, out);
    if (byte_ && !one.is_frame) byte_->on_bytes(one.bytes, now, out);
    if (registers_) answer(*registers_, map_.stride, read_exchange(one.bytes), now, out);
  }
  bool fits(const GoldenCase& one) const {
    if (one.is_exchange) return make_registers_ != nullptr;
    return one.is_frame ? can_ != nullptr : byte_ != nullptr;
  }
  SourceHealth health(Time now) const {
    if (make_registers_ != nullptr) return registers_ ? registers_->health(now) : SourceHealth{};
    return can_ ? can_->health(now) : byte_->health(now);
  }

 private:
  std::unique_ptr<CanDriver> can_;
  std::unique_ptr<ByteDriver> byte_;
  MakeRegisterDriver make_registers_ = nullptr;
  Options options_;
  RegisterMap map_;
  std::unique_ptr<RegisterDriver> registers_;
};

std::string outcome(const GoldenCase& one, AnyDriver& driver, Time now) {
  DriverOut out;
  driver.prepare(one);
  const SourceHealth before = driver.health(now);
  driver.give(one, now, out);
  const SourceHealth after = driver.health(now);
  const std::string text = describe(out);
  if (text != "nothing") return after.bad > before.bad ? text + " and bad" : text;
  if (after.bad > before.bad) return "bad";
  // A case may say "nothing" of what is ignored too; "ignored" is the stricter word.
  return one.expected == "ignored" && after.good == before.good ? "ignored" : "nothing";
}

TEST_P(GoldenBytes, MeanWhatTheirFileSays) {
  const auto files = read_goldens(DROVER_SOURCE_DIR, *GetParam().entry);
  ASSERT_FALSE(files.empty()) << "no drivers/" << GetParam().entry->folder << "/golden/*.txt";
  for (const GoldenFile& file : files) {
    EXPECT_TRUE(file.has_source) << file.path << ": no \"# source:\"";
    EXPECT_TRUE(file.has_provenance) << file.path << ": no \"# provenance:\"";
    EXPECT_FALSE(file.cases.empty()) << file.path;
    AnyDriver driver(*GetParam().entry, file);
    Time now{std::chrono::seconds(1)};
    for (const GoldenCase& one : file.cases) {
      ASSERT_TRUE(driver.fits(one)) << file.path << ":" << one.line;
      now += milliseconds(10);
      EXPECT_EQ(outcome(one, driver, now), one.expected) << file.path.string() << ":" << one.line;
    }
  }
}

std::vector<Subject> speakers() {
  std::vector<Subject> all;
  for (const DriverEntry& entry : driver_registry())
    if (!std::holds_alternative<MakeLineDriver>(entry.make))
      all.push_back({&entry, {}, std::string(entry.name)});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, GoldenBytes, ::testing::ValuesIn(speakers()), label_of);

TEST(Registry, HasNoTwoDriversOfOneNameAndFindsEach) {
  for (const DriverEntry& entry : driver_registry()) {
    EXPECT_EQ(find_driver(entry.name), &entry);
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
  }
  EXPECT_EQ(find_driver("no such driver"), nullptr);
}

TEST(Registry, EveryOptionHasATextAndADefaultInsideItsRange) {
  for (const DriverEntry& entry : driver_registry()) {
    for (const auto table : {entry.options, entry.twin_options}) {
      for (const OptionSpec& spec : table) {
        EXPECT_FALSE(spec.text.empty()) << entry.name << "." << spec.name;
        if (spec.required) continue;
        if (const double* number = std::get_if<double>(&spec.default_value); spec.min < spec.max) {
          ASSERT_NE(number, nullptr) << entry.name << "." << spec.name;
          EXPECT_GE(*number, spec.min) << entry.name << "." << spec.name;
          EXPECT_LE(*number, spec.max) << entry.name << "." << spec.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace drover::test
