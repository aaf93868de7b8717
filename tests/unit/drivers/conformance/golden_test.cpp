// Every driver that speaks a protocol has golden bytes, and they mean what their files say.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"
#include "unit/drivers/conformance/register_harness.h"

namespace drover::test {
namespace {

class GoldenBytes : public ::testing::TestWithParam<Subject> {};

/// The device, whatever its faces. One that is asked for registers is made anew for each case: what
/// was exchanged decides which part of its map it gets.
class AnyDevice {
 public:
  AnyDevice(const DriverEntry& entry, const GoldenFile& file) : entry_(entry), file_(file) {
    if (!file.map.empty()) {
      map_ = read_map(file.map);
    } else {
      made_ = made_of(entry, file.options);
    }
  }
  void prepare(const GoldenCase& one) {
    if (!one.is_exchange || file_.map.empty()) return;
    const auto part = map_inside(map_, read_exchange(one.bytes));
    made_ = made_of(entry_, file_.options, &part);
  }
  void give(const GoldenCase& one, Time now, DriverOut& out) {
    if (one.is_exchange)
      return answer(*made_.registers, map_.stride, read_exchange(one.bytes), now, out);
    if (one.is_frame) return made_.frames->on_frame(one.frame, now, out);
    made_.bytes->on_bytes(one.bytes, now, out);
  }
  bool fits(const GoldenCase& one) const {
    if (one.is_exchange) return made_.registers != nullptr;
    return one.is_frame ? made_.frames != nullptr : made_.bytes != nullptr;
  }
  SourceHealth health(Time now) const { return made_.device->health(now); }
  const Device& device() const { return *made_.device; }

 private:
  const DriverEntry& entry_;
  const GoldenFile& file_;
  RegisterMap map_;
  Made made_;
};

std::string outcome(const GoldenCase& one, AnyDevice& driver, Time now) {
  DriverOut out;
  const SourceHealth before = driver.health(now);
  driver.give(one, now, out);
  const SourceHealth after = driver.health(now);
  const std::string text = describe(out, driver.device());
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
    AnyDevice driver(*GetParam().entry, file);
    Time now{std::chrono::seconds(1)};
    for (const GoldenCase& one : file.cases) {
      driver.prepare(one);
      ASSERT_TRUE(driver.fits(one)) << file.path << ":" << one.line;
      now += milliseconds(10);
      EXPECT_EQ(outcome(one, driver, now), one.expected) << file.path.string() << ":" << one.line;
    }
  }
}

/// What one packet of a scanner says is not what its driver tells: scan_test.cpp.
std::vector<Subject> speakers() {
  std::vector<Subject> all;
  for (const DriverEntry& entry : driver_registry())
    if (!has_face(entry, &Made::levels) && !has_face(entry, &Made::scans))
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

TEST(Registry, MakesOfEachEntryADeviceWithOneFaceForItsWire) {
  for (const DriverEntry& entry : driver_registry()) {
    const int faces = has_face(entry, &Made::frames) + has_face(entry, &Made::bytes) +
                      has_face(entry, &Made::registers) + has_face(entry, &Made::levels) +
                      has_face(entry, &Made::scans);
    EXPECT_EQ(faces, 1) << entry.name;
    EXPECT_EQ(has_face(entry, &Made::frames), entry.wire == Wire::can) << entry.name;
    const bool scans = entry.kind == SlotKind::scanner;
    EXPECT_EQ(has_face(entry, &Made::bytes), entry.wire == Wire::bytes && !scans) << entry.name;
    EXPECT_EQ(has_face(entry, &Made::scans), scans) << entry.name;
    EXPECT_EQ(has_face(entry, &Made::registers), entry.wire == Wire::registers) << entry.name;
    EXPECT_EQ(has_face(entry, &Made::levels), entry.wire == Wire::levels) << entry.name;
    EXPECT_EQ(has_face(entry, &Made::actuator), entry.kind == SlotKind::drive) << entry.name;
    EXPECT_EQ(find_driver(entry.name, SlotKind::line) != nullptr, entry.kind == SlotKind::line);
  }
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
