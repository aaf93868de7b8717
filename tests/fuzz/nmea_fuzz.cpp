// Any bytes into the NMEA 0183 driver: no crash, no absurd value, the same result for any chunking.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/entry.h"
#include "tests/fuzz/chunking.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;
using fuzz::require;

constexpr std::size_t kMaxInput = 8192;
constexpr double kBaud = 115200;
const Time kStart{100s};

bool inside(double value, double min, double max) {
  return std::isnan(value) || (value >= min && value <= max);
}

void check(const Measurement& m) {
  require(m.time <= m.received + 1s);
  if (const auto* p = std::get_if<GnssPosition>(&m.value)) {
    require(inside(p->latitude_deg, -90, 90) && inside(p->longitude_deg, -180, 180));
    const bool fix = p->quality != FixQuality::none;
    require(fix != std::isnan(p->latitude_deg) && fix != std::isnan(p->longitude_deg));
    require(inside(p->altitude_msl_m, -1e5, 1e5) && inside(p->hdop, 0, 99));
    require(inside(p->correction_age_s, 0, 1e6));
    require(inside(p->sigma_east_m, 0, 1e7) && inside(p->sigma_north_m, 0, 1e7));
  } else if (const auto* v = std::get_if<GnssVelocity>(&m.value)) {
    require(v->speed_mps >= 0 && v->speed_mps < 520);
    require(inside(v->course_deg, 0, 359.99999999));
  } else {
    const auto* h = std::get_if<GnssHeading>(&m.value);
    require(h != nullptr && h->heading_deg >= 0 && h->heading_deg < 360);
  }
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void check_same(const Measurement& a, const Measurement& b) {
  require(a.time == b.time && a.value.index() == b.value.index());
  if (const auto* p = std::get_if<GnssPosition>(&a.value)) {
    const auto& q = std::get<GnssPosition>(b.value);
    require(same(p->latitude_deg, q.latitude_deg) && same(p->longitude_deg, q.longitude_deg));
    require(same(p->sigma_east_m, q.sigma_east_m) && p->quality == q.quality);
  } else if (const auto* v = std::get_if<GnssVelocity>(&a.value)) {
    require(same(v->speed_mps, std::get<GnssVelocity>(b.value).speed_mps));
  } else if (const auto* h = std::get_if<GnssHeading>(&a.value)) {
    require(same(h->heading_deg, std::get<GnssHeading>(b.value).heading_deg));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  // The first byte chooses the chunking of the second run, the rest is what the line brings.
  const std::uint32_t choice = data[0];
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const Options options(kNmea0183Entry.options);
  nmea0183::Nmea0183Driver whole(options);
  nmea0183::Nmea0183Driver pieces(options);
  fuzz::check_chunking(whole, pieces, bytes, choice, kStart, kBaud, check, check_same);
  return 0;
}
