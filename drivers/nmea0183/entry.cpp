// Options of the NMEA 0183 driver and its twin, and its line in the registry.
#include "drivers/nmea0183/entry.h"

#include <memory>

#include "drivers/checked_options.h"
#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/twin.h"

namespace drover {
namespace nmea0183 {
namespace {

const OptionSpec kOptions[] = {
    {.name = "latency_s",
     .default_value = 0.08,
     .min = 0.0,
     .max = 1.0,
     .text = "from the instant of measuring to the first byte of the epoch (s); receivers take "
             "10 ms to 100 ms"},
    {.name = "stale_s",
     .default_value = 0.3,
     .min = 0.05,
     .max = 10.0,
     .text = "without a new position for longer the source is stale (s); three periods of 10 Hz"},
    {.name = "rate_Hz",
     .default_value = 10.0,
     .min = 0.2,
     .max = 100.0,
     .text = "epochs a second that the receiver is set to; another pace is told to the operator"},
    {.name = "baud",
     .default_value = 115200.0,
     .min = 4800.0,
     .max = 4000000.0,
     .integer = true,
     .text = "pace of the line (bit/s), as the link is opened with: places each byte in time"},
    {.name = "min_course_speed_mps",
     .default_value = 0.2,
     .min = 0.0,
     .max = 5.0,
     .text = "course over ground is noise below this speed (m/s) and is left out"},
};

constexpr std::string_view kFixes[] = {"fix", "float", "dgps", "single", "none"};
constexpr std::string_view kSpeeds[] = {"signal", "positions"};

const OptionSpec kTwinOptions[] = {
    {.name = "output_rate_Hz",
     .default_value = 10.0,
     .min = 0.2,
     .max = 20.0,
     .text = "epochs a second"},
    {.name = "output_latency_s",
     .default_value = 0.08,
     .min = 0.0,
     .max = 1.0,
     .text = "from the instant of measuring to the first byte (s)"},
    {.name = "utc_start",
     .default_value = std::string("2026-06-01T08:00:00"),
     .text = "UTC of the first instant of the simulation"},
    {.name = "talker", .default_value = std::string("GN"), .text = "two letters"},
    {.name = "first_fix",
     .default_value = std::string("fix"),
     .choices = kFixes,
     .text = "kind of fix at the start"},
    {.name = "sigma_fix_m",
     .default_value = 0.01,
     .min = 0.0,
     .max = 100.0,
     .text = "one sigma of east and of north with RTK fixed (m)"},
    {.name = "sigma_float_m",
     .default_value = 0.3,
     .min = 0.0,
     .max = 100.0,
     .text = "the same with RTK float (m)"},
    {.name = "sigma_dgps_m",
     .default_value = 0.6,
     .min = 0.0,
     .max = 100.0,
     .text = "the same with DGPS (m)"},
    {.name = "sigma_single_m",
     .default_value = 2.0,
     .min = 0.0,
     .max = 100.0,
     .text = "the same without corrections (m)"},
    {.name = "correlation_s",
     .default_value = 30.0,
     .min = 0.1,
     .max = 3600.0,
     .text = "time constant of nine tenths of the error's variance (s); the rest is white"},
    {.name = "heading_sigma_deg",
     .default_value = 0.3,
     .min = 0.0,
     .max = 90.0,
     .text = "one sigma of the heading (degrees); two antennas 2 m apart"},
    {.name = "speed_sigma_mps",
     .default_value = 0.02,
     .min = 0.0,
     .max = 5.0,
     .text = "one sigma of the speed, along and across (m/s)"},
    {.name = "speed_from",
     .default_value = std::string("signal"),
     .choices = kSpeeds,
     .text = "speed and course are measured by themselves, or are those of the told positions, "
             "smoothed over 0.5 s"},
    {.name = "gst", .default_value = true, .text = "it sends GST"},
    {.name = "gst_factor",
     .default_value = 1.0,
     .min = 0.01,
     .max = 100.0,
     .text = "what GST tells for a sigma of one"},
    {.name = "hdt", .default_value = true, .text = "it sends HDT; false: it has one antenna"},
    {.name = "undulation_m",
     .default_value = -8.5,
     .min = -110.0,
     .max = 90.0,
     .text = "geoid above the ellipsoid (m)"},
};

Made make(const Options& options, const MakeContext&) {
  return make_device<Nmea0183Driver>(all_checked(options, kOptions));
}
std::unique_ptr<GnssTwin> make_twin(const Options& options, std::uint64_t seed) {
  return std::make_unique<Nmea0183Twin>(all_checked(options, kTwinOptions), seed);
}

constexpr std::string_view kNmea0183Products[] = {"um980", "um982",   "unicore", "zedf9",
                                                  "ublox", "trimble", "skytraq", "rtk"};

}  // namespace
}  // namespace nmea0183

// Constant, so that the table that copies it is right whichever file starts first.
constinit const DriverEntry kNmea0183Entry{
    .name = "nmea0183",
    .folder = "nmea0183",
    .options = nmea0183::kOptions,
    .kind = SlotKind::gnss,
    .wire = Wire::bytes,
    .make = nmea0183::make,
    .twin_options = nmea0183::kTwinOptions,
    .make_twin = MakeGnssTwin{nmea0183::make_twin},
    .summary = "GNSS receiver with NMEA 0183: GGA, RMC, VTG, GST, HDT or THS",
    .products = nmea0183::kNmea0183Products,
};

}  // namespace drover
