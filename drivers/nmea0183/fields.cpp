// Parsing of single fields; a total function of the text each.
#include "drivers/nmea0183/fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "drivers/nmea0183/block.h"
#include "drover/measurement.h"

namespace drover::nmea0183 {
namespace {

constexpr std::size_t kMaxNumberLength = 20;

// A number of so few digits, and each of these powers, is a double without a rest: their quotient
// is the double that is nearest to the text, as from_chars would find it.
constexpr std::size_t kExactDigits = 15;
constexpr std::array kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}
int two_digits(std::string_view text) {
  return (text[0] - '0') * 10 + (text[1] - '0');
}

/// The number that eight characters are, when all of them are digits: three steps that join
/// neighbours, of one digit, of two, of four.
bool eight_digits(const char* text, std::uint64_t& number) {
  constexpr std::uint64_t kEach = 0x0101010101010101;
  std::uint64_t x = load_eight(text);
  const std::uint64_t high = kEach * 0xF0;
  if ((x & high) != kEach * '0' || ((x + kEach * 6) & high) != kEach * '0') return false;
  x -= kEach * '0';
  x = (x * 10 + (x >> 8U)) & 0x00FF00FF00FF00FF;
  x = (x * 100 + (x >> 16U)) & 0x0000FFFF0000FFFF;
  number = (x * 10000 + (x >> 32U)) & 0xFFFFFFFF;
  return true;
}

/// Behind the last digit; the number grows by them.
const char* take_digits(const char* at, const char* end, std::uint64_t& number) {
  for (; at != end; ++at) {
    const unsigned digit = static_cast<unsigned char>(*at) - unsigned{'0'};
    if (digit > 9) break;
    number = number * 10 + digit;
  }
  return at;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view text) {
  if (text.empty() || text.size() > kMaxNumberLength) return std::nullopt;
  const char* at = text.data();
  const char* end = at + text.size();
  if (*at == '-') ++at;
  // from_chars alone would also take `nan` and `inf`.
  std::uint64_t mantissa = 0;
  const char* begin = at;
  at = take_digits(at, end, mantissa);
  auto digits = static_cast<std::size_t>(at - begin);
  std::size_t decimals = 0;
  if (at != end && *at == '.') {
    begin = ++at;
    // Positions have eight of them and more.
    for (std::uint64_t eight = 0; end - at >= 8 && eight_digits(at, eight); at += 8)
      mantissa = mantissa * 100'000'000 + eight;
    at = take_digits(at, end, mantissa);
    decimals = static_cast<std::size_t>(at - begin);
    digits += decimals;
  }
  if (at != end || digits == 0) return std::nullopt;
  if (digits <= kExactDigits) {
    const double value = static_cast<double>(mantissa) / kPowersOfTen[decimals];
    return text.front() == '-' ? -value : value;
  }
  double value = 0;
  const auto result = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

FieldReader::FieldReader(std::string_view body) : body_(body) {
  const auto end_at = [this](std::size_t comma) {
    if (size_ < kMaxFields) begins_[++size_] = static_cast<std::uint32_t>(comma + 1);
  };
  std::size_t at = 0;
  for (; body.size() - at >= kBlock && size_ < kMaxFields; at += kBlock)
    each_mark(load_block(&body[at]) == ',', [&](std::size_t comma) { end_at(at + comma); });
  for (; at < body.size(); ++at)
    if (body[at] == ',') end_at(at);
  end_at(body.size());
}

double FieldReader::fail_absent() {
  ok_ = false;
  return kAbsent;
}

char FieldReader::letter(std::size_t i) {
  const auto field = text(i);
  if (field.empty()) return '\0';
  if (field.size() == 1) return field[0];
  ok_ = false;
  return '?';
}

void FieldReader::expect_letter_or_empty(std::size_t i, char unit) {
  const char found = letter(i);
  if (found != '\0' && found != unit) ok_ = false;
}

double FieldReader::decimal(std::size_t i, double min, double max) {
  if (text(i).empty()) return kAbsent;
  const auto value = parse_decimal(text(i));
  if (!value || *value < min || *value > max) return fail_absent();
  return *value;
}

std::optional<int> FieldReader::integer(std::size_t i, int max) {
  const auto field = text(i);
  if (field.empty()) return std::nullopt;
  if (field.size() > 4 || !all_digits(field)) {
    ok_ = false;
    return std::nullopt;
  }
  int value = 0;
  for (const char c : field) value = value * 10 + (c - '0');
  if (value > max) {
    ok_ = false;
    return std::nullopt;
  }
  return value;
}

double FieldReader::angle_deg(std::size_t i, std::size_t degree_digits, double limit_deg,
                              std::string_view hemispheres) {
  const auto field = text(i);
  const char hemisphere = letter(i + 1);
  if (hemisphere != '\0' && hemispheres.find(hemisphere) == std::string_view::npos)
    return fail_absent();
  if (field.empty()) return kAbsent;
  // The number of digits before the point is fixed. A sign would negate twice: it is no digit.
  const auto whole = field.substr(0, field.find('.'));
  if (hemisphere == '\0' || whole.size() != degree_digits + 2 || !all_digits(whole))
    return fail_absent();
  int degrees = 0;
  for (const char c : whole.substr(0, degree_digits)) degrees = degrees * 10 + (c - '0');
  const auto minutes = parse_decimal(field.substr(degree_digits));
  if (!minutes || *minutes >= 60.0) return fail_absent();
  const double angle = degrees + *minutes / 60.0;
  if (angle > limit_deg) return fail_absent();
  return hemisphere == hemispheres[0] ? angle : -angle;
}

double FieldReader::direction_deg(std::size_t i) {
  const double value = decimal(i, 0.0, 360.0);
  return value == 360.0 ? 0.0 : value;
}

std::optional<Duration> FieldReader::time_of_day(std::size_t i) {
  const auto field = text(i);
  if (field.empty()) return std::nullopt;
  const auto whole = field.substr(0, 6);
  const auto fraction = field.substr(whole.size());
  const bool shaped =
      whole.size() == 6 && all_digits(whole) &&
      (fraction.empty() || (fraction[0] == '.' && fraction.size() <= 10 &&
                            (fraction.size() == 1 || all_digits(fraction.substr(1)))));
  if (!shaped) {
    ok_ = false;
    return std::nullopt;
  }
  const int hour = two_digits(whole);
  const int minute = two_digits(whole.substr(2));
  const int second = two_digits(whole.substr(4));
  const bool leap = hour == 23 && minute == 59 && second == 60;
  if (hour > 23 || minute > 59 || (second > 59 && !leap)) {
    ok_ = false;
    return std::nullopt;
  }
  std::int64_t nanoseconds = 0;
  std::int64_t unit_ns = 100'000'000;
  for (std::size_t digit = 1; digit < fraction.size(); ++digit, unit_ns /= 10)
    nanoseconds += unit_ns * (fraction[digit] - '0');
  return std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second) +
         Duration(nanoseconds);
}

}  // namespace drover::nmea0183
