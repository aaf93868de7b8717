// Parsing of single fields; a total function of the text each.
#include "drivers/nmea0183/fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "drivers/nmea0183/block.h"
#include "drover/measurement.h"

namespace drover::nmea0183 {
namespace {

constexpr std::size_t kMaxNumberLength = 20;

// A number of so few digits, and each of these powers, is a double without a rest: their quotient
// is the double that is nearest to the text, as from_chars would find it.
constexpr std::ptrdiff_t kExactDigits = 15;
constexpr std::array kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
/// The number that the next two characters are; none above 99 when they are no digits.
int two_digits(std::string_view text, std::size_t at) {
  constexpr int kNone = 100;
  const char tens = text[at];
  const char ones = text[at + 1];
  return is_digit(tens) && is_digit(ones) ? (tens - '0') * 10 + (ones - '0') : kNone;
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

/// A plain decimal number that has more digits than a double holds.
[[gnu::noinline]] double read_long_decimal(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  return result.ec == std::errc{} && result.ptr == end ? value : kAbsent;
}

/// A plain decimal number; absent when it is none.
double read_decimal(std::string_view text) {
  if (text.empty() || text.size() > kMaxNumberLength) return kAbsent;
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool negative = *at == '-';
  if (negative) ++at;
  // from_chars alone would also take `nan` and `inf`.
  std::uint64_t mantissa = 0;
  const char* const begin = at;
  at = take_digits(at, end, mantissa);
  std::ptrdiff_t digits = at - begin;
  std::ptrdiff_t decimals = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    // Positions have eight of them and more.
    if (std::uint64_t eight = 0; end - at >= 8 && eight_digits(at, eight)) {
      mantissa = mantissa * 100'000'000 + eight;
      at += 8;
    }
    at = take_digits(at, end, mantissa);
    decimals = at - point - 1;
    digits += decimals;
  }
  if (at != end || digits == 0) return kAbsent;
  if (digits > kExactDigits) return read_long_decimal(text);
  const double value = static_cast<double>(static_cast<std::int64_t>(mantissa)) /
                       kPowersOfTen[static_cast<std::size_t>(decimals)];
  return negative ? -value : value;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view text) {
  const double value = read_decimal(text);
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

FieldReader::FieldReader(std::string_view body) : body_(body) {
  // What finds no room is beyond all that is read.
  const auto end_at = [this](std::size_t comma) {
    (void)begins_.push_back(static_cast<std::uint32_t>(comma + 1));
  };
  (void)begins_.push_back(0);
  std::size_t at = 0;
  for (; body.size() - at >= kBlock && !begins_.full(); at += kBlock)
    each_mark(load_block(&body[at]) == ',', [&](std::size_t comma) { end_at(at + comma); });
  for (; at < body.size(); ++at)
    if (body[at] == ',') end_at(at);
  end_at(body.size());
}

double FieldReader::fail_absent() {
  ok_ = false;
  return kAbsent;
}

std::nullopt_t FieldReader::fail_unknown() {
  ok_ = false;
  return std::nullopt;
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
  const auto field = text(i);
  if (field.empty()) return kAbsent;
  const double value = read_decimal(field);
  return value >= min && value <= max ? value : fail_absent();
}

std::optional<int> FieldReader::integer(std::size_t i, int max) {
  const auto field = text(i);
  if (field.empty()) return std::nullopt;
  const bool digits = field.size() <= 4 && std::all_of(field.begin(), field.end(), is_digit);
  int value = 0;
  for (const char c : field.substr(0, 4)) value = value * 10 + (c - '0');
  if (!digits || value > max) return fail_unknown();
  return value;
}

double FieldReader::angle_deg(std::size_t i, std::size_t degree_digits, double limit_deg,
                              std::string_view hemispheres) {
  const auto field = text(i);
  const char hemisphere = letter(i + 1);
  if (hemisphere != '\0' && hemisphere != hemispheres[0] && hemisphere != hemispheres[1])
    return fail_absent();
  if (field.empty()) return kAbsent;
  // The number of digits before the point is fixed. A sign would negate twice: it is no digit.
  const std::size_t point = degree_digits + 2;
  if (hemisphere == '\0' || field.size() < point || (field.size() > point && field[point] != '.'))
    return fail_absent();
  int whole = 0;
  for (const char c : field.substr(0, point)) {
    if (!is_digit(c)) return fail_absent();
    whole = whole * 10 + (c - '0');
  }
  const double minutes = read_decimal(field.substr(degree_digits));
  if (!(minutes < 60.0)) return fail_absent();
  const int degrees = whole / 100;  // two digits of minutes behind them
  const double angle = degrees + minutes / 60.0;
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
  constexpr std::size_t kPoint = 6;
  constexpr std::size_t kDecimals = 9;  // nanoseconds
  const bool shaped = field.size() == kPoint || (field.size() > kPoint && field[kPoint] == '.' &&
                                                 field.size() <= kPoint + 1 + kDecimals);
  if (!shaped) return fail_unknown();
  const int hour = two_digits(field, 0);
  const int minute = two_digits(field, 2);
  const int second = two_digits(field, 4);
  const bool leap = hour == 23 && minute == 59 && second == 60;
  if (hour > 23 || minute > 59 || (second > 59 && !leap)) return fail_unknown();
  std::int64_t nanoseconds = 0;
  std::int64_t unit_ns = 100'000'000;
  for (std::size_t digit = kPoint + 1; digit < field.size(); ++digit, unit_ns /= 10) {
    if (!is_digit(field[digit])) return fail_unknown();
    nanoseconds += unit_ns * (field[digit] - '0');
  }
  return std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second) +
         Duration(nanoseconds);
}

}  // namespace drover::nmea0183
