// Writes the five sentences of an epoch, for the simulated receiver and for tests.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "drover/measurement.h"
#include "drover/time.h"

namespace drover::nmea0183 {

/// What a receiver knows at one instant; absent values become empty fields.
struct Solution {
  Duration utc_of_day{};
  int year = 2026;
  int month = 1;
  int day = 1;
  GnssPosition position;
  double sigma_up_m = kAbsent;
  GnssVelocity velocity;
  GnssHeading heading;
};

/// The longest epoch that compose() writes.
inline constexpr std::size_t kMaxEpochBytes = 512;

/// Writes sentences into a buffer; what does not fit is left out and full() tells.
class Composer final {
 public:
  Composer(std::span<char> out, std::string_view talker) : out_(out), talker_(talker) {}

  void gga(const Solution& solution);
  void rmc(const Solution& solution);
  void vtg(const Solution& solution);
  void gst(const Solution& solution);
  void hdt(const Solution& solution);

  std::size_t size() const { return size_; }
  bool full() const { return full_; }

 private:
  void begin(std::string_view type);
  void end();
  void put(char c);
  void put(std::string_view text);
  void put_number(double value, int decimals);  ///< nothing when absent
  void put_digits(long value, int digits);
  void put_time(Duration utc_of_day);
  void put_angle(double angle_deg, int degree_digits, char positive, char negative);
  void put_place(const GnssPosition& position);

  std::span<char> out_;
  std::string_view talker_;
  std::size_t size_ = 0;
  std::size_t start_ = 0;  ///< of the sentence's body
  bool full_ = false;
};

/// What not every receiver sends.
struct Sentences {
  bool gst = true;
  bool hdt = true;
};

/// GGA, RMC, VTG, GST, HDT in this order. Returns the bytes written; 0 when they do not fit.
std::size_t compose(const Solution& solution, std::string_view talker, std::span<char> out,
                    Sentences sends = {});

}  // namespace drover::nmea0183
