// Parsing of single fields; a total function of the text each.
#include "drivers/nmea0183/fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

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

}  // namespace

std::optional<double> parse_decimal(std::string_view text) {
  if (text.empty() || text.size() > kMaxNumberLength) return std::nullopt;
  std::string_view rest = text;
  if (rest.front() == '-') rest.remove_prefix(1);
  // from_chars alone would also take `nan` and `inf`.
  std::size_t digits = 0;
  std::size_t points = 0;
  std::size_t decimals = 0;
  std::uint64_t mantissa = 0;
  for (const char c : rest) {
    if (is_digit(c)) {
      ++digits;
      decimals += points;
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(c - '0');
    } else if (c == '.') {
      ++points;
    } else {
      return std::nullopt;
    }
  }
  if (digits == 0 || points > 1) return std::nullopt;
  if (digits <= kExactDigits) {
    const double value = static_cast<double>(mantissa) / kPowersOfTen[decimals];
    return text.front() == '-' ? -value : value;
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

FieldReader::FieldReader(std::string_view body) {
  while (size_ < kMaxFields) {
    const std::size_t comma = body.find(',');
    fields_[size_++] = body.substr(0, comma);
    if (comma == std::string_view::npos) break;
    body.remove_prefix(comma + 1);
  }
}

std::string_view FieldReader::text(std::size_t i) const {
  return i < size_ ? fields_[i] : std::string_view{};
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
  const auto degrees = parse_decimal(field.substr(0, degree_digits));
  const auto minutes = parse_decimal(field.substr(degree_digits));
  if (!degrees || !minutes || *minutes >= 60.0) return fail_absent();
  const double angle = *degrees + *minutes / 60.0;
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
  for (std::size_t digit = 1; digit < 10; ++digit)
    nanoseconds = nanoseconds * 10 + (digit < fraction.size() ? fraction[digit] - '0' : 0);
  return std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second) +
         Duration(nanoseconds);
}

}  // namespace drover::nmea0183
