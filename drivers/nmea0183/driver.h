// Driver of a GNSS receiver that speaks NMEA 0183: position, speed and heading by epochs.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/nmea0183/codec.h"
#include "drivers/nmea0183/framer.h"
#include "drivers/nmea0183/time_anchor.h"
#include "drover/driver.h"
#include "drover/options.h"

namespace drover::nmea0183 {

/// Reports GnssPosition as soon as GGA is in, GnssVelocity from VTG (RMC where there is no VTG) and
/// GnssHeading from HDT or THS.
///
/// Time. A receiver measures at one instant and tells it in a burst of sentences, an epoch. All
/// measurements of an epoch carry the same instant: the arrival of the first byte of the epoch's
/// first sentence, freed from delays on the way (TimeAnchor), minus the option `latency_s`, the
/// receiver's own time between measuring and the first byte. Sentences belong to one epoch when
/// they carry the same UTC; those without UTC (VTG, HDT, THS) belong to the burst they come in.
class Nmea0183Driver final : public Device, public ByteFace {
 public:
  /// Throws std::runtime_error when options contradict each other.
  explicit Nmea0183Driver(const Options& options);

  void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) override;
  void on_tick(Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;

 private:
  enum Kind : std::uint8_t { gga = 1, rmc = 2, vtg = 4, gst = 8, heading = 16 };
  struct Epoch {
    Time first_byte = kNever;  ///< of the first sentence
    Time last_byte = kNever;   ///< of the latest sentence
    std::optional<Duration> utc;
    Time due = kNever;       ///< `first_byte` freed from delays
    std::uint8_t kinds = 0;  ///< sentences seen
    bool velocity_reported = false;
  };
  /// Sigmas count for a position only when both are of one kind of fix.
  struct Sigmas {
    Gst gst;
    Time at = kNever;
    std::optional<FixQuality> quality;
  };
  /// The sentence being handled: where it began and ended, and its chunk's time.
  struct Arrival {
    Time first_byte = kNever;
    Time last_byte = kNever;
    Time received = kNever;
  };

  void on_sentence(const Arrival& at, DriverOut& out);
  void on_gga(const Gga& gga, const Arrival& at, DriverOut& out);
  void on_rmc(const Rmc& rmc, const Arrival& at, DriverOut& out);
  void on_vtg(const Vtg& vtg, const Arrival& at, DriverOut& out);
  void on_gst(const Gst& gst, const Arrival& at);
  void on_heading(const Heading& heading, const Arrival& at, DriverOut& out);

  bool is_late(std::optional<Duration> utc) const;
  void join_epoch(Kind kind, std::optional<Duration> utc, const Arrival& at);
  void add_sigmas(const Gga& gga, Time at, GnssPosition& position);
  void report_velocity(GnssVelocity velocity, const Arrival& at, DriverOut& out);
  template <class Value>
  void report(const Value& value, const Arrival& at, DriverOut& out);
  void note_pace(Duration utc);
  void explain_silence(Time now, Reason& reason) const;
  void explain_oddity(Time now, Reason& reason) const;

  Duration latency_;
  Duration stale_;
  Duration byte_time_;
  double rate_Hz_;
  double min_course_speed_mps_;
  Duration burst_gap_;  ///< a pause longer than this separates two epochs

  Framer framer_;
  TimeAnchor anchor_;
  Time sentence_first_byte_ = kNever;
  Epoch epoch_;
  Sigmas sigmas_;
  FixQuality quality_ = FixQuality::none;
  std::optional<Duration> position_utc_;

  Time last_byte_ = kNever;
  Time noise_since_ = kNever;  ///< first byte after the latest good sentence of any type
  Time last_sentence_ = kNever;
  Time last_news_ = kNever;
  Time last_position_ = kNever;
  Time last_vtg_ = kNever;
  Time last_heading_ = kNever;
  Time last_repeat_ = kNever;  ///< a position came whose UTC did not advance
  Heading::From heading_from_ = Heading::From::hdt;
  Oddity gga_oddity_ = Oddity::none;
  Oddity date_oddity_ = Oddity::none;
  double epoch_period_s_ = kAbsent;
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
};

}  // namespace drover::nmea0183
