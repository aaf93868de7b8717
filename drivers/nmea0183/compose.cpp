// Sentence writing without locale: numbers through to_chars, angles through whole numbers.
#include "drivers/nmea0183/compose.h"

#include <array>
#include <charconv>
#include <cmath>

namespace drover::nmea0183 {
namespace {

constexpr double kKnotsPerMps = 3600.0 / 1852.0;
constexpr double kKmphPerMps = 3.6;

// The letter of RMC and VTG for a GGA quality (NMEA 0183 version 2.3 and later).
char mode_letter(FixQuality quality) {
  switch (quality) {
    case FixQuality::single: return 'A';
    case FixQuality::dgps: return 'D';
    case FixQuality::pps: return 'P';
    case FixQuality::rtk_fixed: return 'R';
    case FixQuality::rtk_float: return 'F';
    case FixQuality::estimated: return 'E';
    case FixQuality::manual: return 'M';
    case FixQuality::simulator: return 'S';
    case FixQuality::none: break;
  }
  return 'N';
}

// 359.9996 must not be written as 360.000.
double rounded_direction_deg(double direction_deg) {
  const double rounded = std::round(direction_deg * 1000) / 1000;
  return rounded >= 360 ? 0 : rounded;
}

}  // namespace

void Composer::put(char c) {
  if (size_ == out_.size()) {
    full_ = true;
    return;
  }
  out_[size_++] = c;
}

void Composer::put(std::string_view text) {
  for (const char c : text) put(c);
}

void Composer::put_number(double value, int decimals) {
  if (!std::isfinite(value)) return;
  std::array<char, 64> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::fixed, decimals);
  if (result.ec == std::errc{})
    put(std::string_view(text.data(), static_cast<std::size_t>(result.ptr - text.data())));
}

void Composer::put_digits(long value, int digits) {
  std::array<char, 20> text{};
  for (int i = digits - 1; i >= 0; --i) {
    text[static_cast<std::size_t>(i)] = static_cast<char>('0' + value % 10);
    value /= 10;
  }
  put(std::string_view(text.data(), static_cast<std::size_t>(digits)));
}

void Composer::put_time(Duration utc_of_day) {
  const long hundredths = static_cast<long>((utc_of_day.count() + 5'000'000) / 10'000'000);
  const long seconds = hundredths / 100 % 86400;
  put_digits(seconds / 3600, 2);
  put_digits(seconds / 60 % 60, 2);
  put_digits(seconds % 60, 2);
  put('.');
  put_digits(hundredths % 100, 2);
}

void Composer::put_angle(double angle_deg, int degree_digits, char positive, char negative) {
  if (std::isfinite(angle_deg)) {
    constexpr long kPerMinute = 100'000'000;  // eight decimals, about 20 micrometres
    const long units = std::lround(std::abs(angle_deg) * 60 * static_cast<double>(kPerMinute));
    put_digits(units / (60 * kPerMinute), degree_digits);
    put_digits(units / kPerMinute % 60, 2);
    put('.');
    put_digits(units % kPerMinute, 8);
    put(',');
    put(angle_deg < 0 ? negative : positive);
  } else {
    put(',');
  }
}

void Composer::put_place(const GnssPosition& position) {
  put_angle(position.latitude_deg, 2, 'N', 'S');
  put(',');
  put_angle(position.longitude_deg, 3, 'E', 'W');
}

void Composer::begin(std::string_view type) {
  put('$');
  start_ = size_;
  put(talker_);
  put(type);
  put(',');
}

void Composer::end() {
  static constexpr std::string_view kHex = "0123456789ABCDEF";
  unsigned sum = 0;
  for (std::size_t i = start_; i < size_; ++i) sum ^= static_cast<unsigned char>(out_[i]);
  put('*');
  put(kHex[sum >> 4U]);
  put(kHex[sum & 0xFU]);
  put("\r\n");
}

void Composer::gga(const Solution& solution) {
  const GnssPosition& position = solution.position;
  begin("GGA");
  put_time(solution.utc_of_day);
  put(',');
  put_place(position);
  put(',');
  put_digits(static_cast<long>(position.quality), 1);
  put(',');
  put_digits(position.satellites, 2);
  put(',');
  put_number(position.hdop, 1);
  put(',');
  put_number(position.altitude_msl_m, 4);
  put(",M,");
  put_number(position.undulation_m, 4);
  put(",M,");
  put_number(position.correction_age_s, 1);
  put(std::isfinite(position.correction_age_s) ? ",0001" : ",");
  end();
}

void Composer::rmc(const Solution& solution) {
  const bool valid = solution.position.quality != FixQuality::none;
  begin("RMC");
  put_time(solution.utc_of_day);
  put(valid ? ",A," : ",V,");
  put_place(solution.position);
  put(',');
  put_number(solution.velocity.speed_mps * kKnotsPerMps, 3);
  put(',');
  put_number(rounded_direction_deg(solution.velocity.course_deg), 3);
  put(',');
  put_digits(solution.day, 2);
  put_digits(solution.month, 2);
  put_digits(solution.year % 100, 2);
  put(",,,");
  put(mode_letter(solution.position.quality));
  put(",V");
  end();
}

void Composer::vtg(const Solution& solution) {
  begin("VTG");
  put_number(rounded_direction_deg(solution.velocity.course_deg), 3);
  put(",T,,M,");
  put_number(solution.velocity.speed_mps * kKnotsPerMps, 3);
  put(",N,");
  put_number(solution.velocity.speed_mps * kKmphPerMps, 3);
  put(",K,");
  put(mode_letter(solution.position.quality));
  end();
}

void Composer::gst(const Solution& solution) {
  begin("GST");
  put_time(solution.utc_of_day);
  put(",,,,,");
  put_number(solution.position.sigma_north_m, 3);
  put(',');
  put_number(solution.position.sigma_east_m, 3);
  put(',');
  put_number(solution.sigma_up_m, 3);
  end();
}

void Composer::hdt(const Solution& solution) {
  begin("HDT");
  put_number(rounded_direction_deg(solution.heading.heading_deg), 3);
  put(",T");
  end();
}

std::size_t compose(const Solution& solution, std::string_view talker, std::span<char> out,
                    Sentences sends) {
  Composer composer(out, talker);
  composer.gga(solution);
  composer.rmc(solution);
  composer.vtg(solution);
  if (sends.gst) composer.gst(solution);
  if (sends.hdt) composer.hdt(solution);
  return composer.full() ? 0 : composer.size();
}

}  // namespace drover::nmea0183
