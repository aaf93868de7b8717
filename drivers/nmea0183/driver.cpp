// Assembly of epochs from sentences, and what becomes of each sentence.
#include "drivers/nmea0183/driver.h"

#include <cmath>
#include <stdexcept>

namespace drover::nmea0183 {
namespace {

constexpr Duration kSigmasKeep = std::chrono::seconds(1);
constexpr Duration kVtgKeep = std::chrono::seconds(1);
constexpr Duration kHeadingKeep = std::chrono::seconds(1);
// GST or RMC of the epoch before may come after the first sentence of the next.
constexpr Duration kMaxDisorder = std::chrono::seconds(1);
constexpr double kPaceWeight = 0.2;

}  // namespace

Nmea0183Driver::Nmea0183Driver(const Options& options)
    : latency_(from_s(options.number("latency_s"))),
      stale_(from_s(options.number("stale_s"))),
      byte_time_(from_s(kBitsPerByte / options.number("baud"))),
      rate_Hz_(options.number("rate_Hz")),
      min_course_speed_mps_(options.number("min_course_speed_mps")),
      burst_gap_(from_s(0.6 / rate_Hz_)) {
  if (to_s(stale_) * rate_Hz_ < 1.5)
    throw std::runtime_error("stale_s is shorter than one and a half periods of rate_Hz");
}

void Nmea0183Driver::on_bytes(std::span<const std::uint8_t> bytes, Time first_byte,
                              DriverOut& out) {
  if (bytes.empty()) return;
  if (noise_since_ == kNever) noise_since_ = first_byte;
  last_byte_ = first_byte;
  // A chunk may hold several sentences: the line's pace says when each byte came.
  Time at = first_byte;
  while (true) {
    const std::size_t dull = framer_.take_dull(bytes);
    bytes = bytes.subspan(dull);
    at += static_cast<Duration::rep>(dull) * byte_time_;
    if (bytes.empty()) return;
    const std::uint8_t byte = bytes.front();
    bytes = bytes.subspan(1);
    if (byte == '$') sentence_first_byte_ = at;
    switch (framer_.push(byte)) {
      case Framer::Event::sentence:
        last_sentence_ = first_byte;
        noise_since_ = kNever;
        on_sentence({sentence_first_byte_, at, first_byte}, out);
        break;
      case Framer::Event::dropped: ++bad_; break;
      case Framer::Event::foreign:
      case Framer::Event::none: break;
    }
    at += byte_time_;
  }
}

// Everything that happens by time is in health(); nothing is due by itself.
void Nmea0183Driver::on_tick(Time, DriverOut&) {}

void Nmea0183Driver::on_link_up(Time) {
  framer_.reset();
  anchor_.reset();
  epoch_ = Epoch{};
  sigmas_ = Sigmas{};
  position_utc_.reset();
  noise_since_ = kNever;
  epoch_period_s_ = kAbsent;
}

void Nmea0183Driver::on_sentence(const Arrival& at, DriverOut& out) {
  const auto sentence = decode(framer_.body());
  if (!sentence) {
    ++bad_;
    return;
  }
  if (std::holds_alternative<Other>(*sentence)) return;
  ++good_;
  if (const auto* position = std::get_if<Gga>(&*sentence)) on_gga(*position, at, out);
  if (const auto* minimum = std::get_if<Rmc>(&*sentence)) on_rmc(*minimum, at, out);
  if (const auto* velocity = std::get_if<Vtg>(&*sentence)) on_vtg(*velocity, at, out);
  if (const auto* statistics = std::get_if<Gst>(&*sentence)) on_gst(*statistics, at);
  if (const auto* direction = std::get_if<Heading>(&*sentence)) on_heading(*direction, at, out);
  // A receiver that gives no position is heard by whatever it says. One that does must go on
  // telling new positions: all else may be chatter of a receiver whose solution has stopped.
  if (last_position_ == kNever) last_news_ = at.received;
}

void Nmea0183Driver::on_gga(const Gga& sentence, const Arrival& at, DriverOut& out) {
  if (sentence.utc && position_utc_ == sentence.utc) {
    last_repeat_ = at.received;
    return;
  }
  join_epoch(Kind::gga, sentence.utc, at);
  if (sentence.utc) note_pace(*sentence.utc);
  position_utc_ = sentence.utc;
  quality_ = sentence.position.quality;
  gga_oddity_ = sentence.oddity;
  GnssPosition position = sentence.position;
  add_sigmas(sentence, at.received, position);
  report(position, at, out);
  last_position_ = at.received;
  last_news_ = epoch_.due;
}

void Nmea0183Driver::on_rmc(const Rmc& sentence, const Arrival& at, DriverOut& out) {
  date_oddity_ = sentence.oddity;
  if (is_late(sentence.utc)) return;
  join_epoch(Kind::rmc, sentence.utc, at);
  if (at.received - last_vtg_ > kVtgKeep) report_velocity(sentence.velocity, at, out);
}

void Nmea0183Driver::on_vtg(const Vtg& sentence, const Arrival& at, DriverOut& out) {
  join_epoch(Kind::vtg, std::nullopt, at);
  last_vtg_ = at.received;
  report_velocity(sentence.velocity, at, out);
}

void Nmea0183Driver::on_gst(const Gst& sentence, const Arrival& at) {
  if (!is_late(sentence.utc)) join_epoch(Kind::gst, sentence.utc, at);
  sigmas_ = {sentence, at.received, std::nullopt};
  if (sentence.utc && sentence.utc == position_utc_) sigmas_.quality = quality_;
}

void Nmea0183Driver::on_heading(const Heading& sentence, const Arrival& at, DriverOut& out) {
  // A receiver may send both HDT and THS: one is enough.
  if (sentence.from != heading_from_ && at.received - last_heading_ <= kHeadingKeep) return;
  heading_from_ = sentence.from;
  join_epoch(Kind::heading, std::nullopt, at);
  if (std::isnan(sentence.heading_deg)) return;
  last_heading_ = at.received;
  report(GnssHeading{sentence.heading_deg}, at, out);
}

bool Nmea0183Driver::is_late(std::optional<Duration> utc) const {
  if (!utc || !epoch_.utc) return false;
  const Duration step = step_of_day(*epoch_.utc, *utc);
  return step < Duration::zero() && step >= -kMaxDisorder;
}

// A sentence with another UTC begins a new epoch. So does one without UTC whose kind was already
// there, or that comes after a pause: the sentence with UTC that follows it then joins it.
void Nmea0183Driver::join_epoch(Kind kind, std::optional<Duration> utc, const Arrival& at) {
  const bool another_burst =
      (epoch_.kinds & kind) != 0 || at.first_byte - epoch_.last_byte > burst_gap_;
  const bool begins = utc && epoch_.utc ? *utc != *epoch_.utc : another_burst;
  if (begins) {
    epoch_ = Epoch{};
    epoch_.first_byte = at.first_byte;
    epoch_.due = at.first_byte;
  }
  epoch_.last_byte = at.last_byte;
  epoch_.kinds = static_cast<std::uint8_t>(epoch_.kinds | kind);
  if (utc && !epoch_.utc) {
    epoch_.utc = utc;
    epoch_.due = anchor_.due(*utc, epoch_.first_byte);
  }
}

// Sigmas of this epoch, or recent ones. Those of a fixed solution must not be given to the single
// one after it, so recent ones count only when their position was of the same quality.
void Nmea0183Driver::add_sigmas(const Gga& sentence, Time at, GnssPosition& position) {
  if (sentence.utc && sigmas_.gst.utc == sentence.utc) sigmas_.quality = position.quality;
  const bool recent = at - sigmas_.at <= kSigmasKeep;
  if (position.quality == FixQuality::none || !recent || sigmas_.quality != position.quality)
    return;
  position.sigma_east_m = sigmas_.gst.sigma_east_m;
  position.sigma_north_m = sigmas_.gst.sigma_north_m;
  position.sigma_up_m = sigmas_.gst.sigma_up_m;
}

void Nmea0183Driver::report_velocity(GnssVelocity velocity, const Arrival& at, DriverOut& out) {
  if (epoch_.velocity_reported || std::isnan(velocity.speed_mps)) return;
  if (velocity.speed_mps < min_course_speed_mps_) velocity.course_deg = kAbsent;
  epoch_.velocity_reported = true;
  report(velocity, at, out);
}

template <class Value>
void Nmea0183Driver::report(const Value& value, const Arrival& at, DriverOut& out) {
  out.report(epoch_.due - latency_, at.received, value);
}

void Nmea0183Driver::note_pace(Duration utc) {
  if (!position_utc_) return;
  const double period_s = to_s(step_of_day(*position_utc_, utc));
  if (period_s <= 0 || period_s > 60) return;
  if (std::isnan(epoch_period_s_)) epoch_period_s_ = period_s;
  epoch_period_s_ += kPaceWeight * (period_s - epoch_period_s_);
}

}  // namespace drover::nmea0183
