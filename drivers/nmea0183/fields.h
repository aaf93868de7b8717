// Fields of a sentence and the strict grammar of what they hold: no locale, no nan, no exponent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/fixed_vector.h"
#include "drover/time.h"

namespace drover::nmea0183 {

/// Reads fields by number (0 is the address). Empty and missing fields are "not known": NaN or
/// nullopt. A field that is there but wrong makes ok() false for good, so one check at the end is
/// enough.
class FieldReader final {
 public:
  explicit FieldReader(std::string_view body);

  std::size_t size() const { return begins_.size() - 1; }
  bool ok() const { return ok_; }
  void fail() { ok_ = false; }

  /// Empty when the sentence has no such field.
  std::string_view text(std::size_t i) const {
    if (i >= size()) return {};
    return {body_.data() + begins_[i], begins_[i + 1] - 1 - begins_[i]};
  }
  /// One letter, '\0' when the field is empty, '?' (and a failure) when it is longer.
  char letter(std::size_t i);
  /// Fails when the field is neither empty nor `unit`.
  void expect_letter_or_empty(std::size_t i, char unit);
  /// [-]digits[.digits], inside [min, max].
  double decimal(std::size_t i, double min, double max);
  /// Up to four digits, not above `max`.
  std::optional<int> integer(std::size_t i, int max);
  /// Degrees and minutes without a point between, hemisphere in the next field; north is positive.
  double latitude_deg(std::size_t i) { return angle_deg(i, 2, 90, "NS"); }
  /// East is positive.
  double longitude_deg(std::size_t i) { return angle_deg(i, 3, 180, "EW"); }
  /// Clockwise from north, [0, 360); 360 is what some receivers round to, and is 0.
  double direction_deg(std::size_t i);
  /// hhmmss[.s...] as time since midnight. 23:59:60 is a leap second and is 24 h and a bit.
  std::optional<Duration> time_of_day(std::size_t i);

 private:
  static constexpr std::size_t kMaxFields = 32;

  double angle_deg(std::size_t i, std::size_t degree_digits, double limit_deg,
                   std::string_view hemispheres);
  double fail_absent();
  std::nullopt_t fail_unknown();

  std::string_view body_;
  /// Where each begins; the one after the last begins behind the comma that would end it.
  FixedVector<std::uint32_t, kMaxFields + 1> begins_;
  bool ok_ = true;
};

/// A plain decimal number; nullopt for everything else (`nan`, `inf`, `1e5`, `0x10`, `+1`, ` 1`).
std::optional<double> parse_decimal(std::string_view text);

}  // namespace drover::nmea0183
