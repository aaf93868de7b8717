// The driver allocates nothing once it exists.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/entry.h"
#include "drivers/nmea0183/twin.h"
#include "support/allocation_counter.h"
#include "unit/drivers/nmea0183/lines.h"

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

TEST(NmeaAllocation, IsNoneInAnyCallOfTheDriver) {
  Nmea0183Driver driver{Options(kNmea0183Entry.options)};
  Nmea0183Twin twin{Options(kNmea0183Entry.twin_options), 3};
  const std::string odd = test::line("GNGGA,103607.00,nan,N,00214.42462,W,4,06,5.88,inf,M,48.5,M") +
                          "$GNGLL,1*00\r\n" + test::line("PXYZ,1") + std::string(3000, '$') +
                          "\x80";
  DriverOut out;
  std::array<char, 4096> buffer{};
  std::size_t measurements = 0;
  std::size_t reasons = 0;

  const drover::test::AllocationCounter counter;
  Time now{10s};
  driver.on_link_up(now);
  for (int i = 0; i < 2000; ++i, now += 5ms) {
    if (i == 500) driver.on_bytes(test::bytes(odd), now, out);
    if (i > 1000 && i < 1500) continue;  // silence, so that health has something to explain
    const auto size = twin.on_tick(now, GnssTruth{.latitude_deg = 31, .speed_mps = 1}, buffer);
    driver.on_bytes(test::bytes({buffer.data(), size}), now, out);
    driver.on_tick(now, out);
    measurements += out.measurements.size();
    reasons += driver.health(now + 400ms).reason.empty() ? 0 : 1;
    out.clear();
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(measurements, 150U);
  EXPECT_GT(reasons, 0U);
}

}  // namespace
}  // namespace drover::nmea0183
