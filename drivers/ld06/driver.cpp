#include "drivers/ld06/driver.h"

namespace drover::ld06 {

Ld06Driver::Ld06Driver(const Options& options)
    : settings_(read_settings(options)),
      byte_time_(from_s(kBitsPerByte / settings_.baud)),
      turns_(settings_.upside_down),
      watch_(settings_) {}

void Ld06Driver::on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, ScanOut& out) {
  if (bytes.empty()) return;
  if (noise_since_ == kNever) noise_since_ = first_byte;
  last_byte_ = first_byte;
  // A chunk may hold many packets: the line's pace says when each byte came.
  Time at = first_byte;
  for (const std::uint8_t byte : bytes) {
    switch (framer_.push(byte)) {
      case Framer::Event::packet:
        on_packet(at - static_cast<long>(kPacketSize - 1) * byte_time_, first_byte, out);
        break;
      case Framer::Event::dropped: ++bad_; break;
      case Framer::Event::none: break;
    }
    at += byte_time_;
  }
}

void Ld06Driver::on_packet(Time first_byte, Time received, ScanOut& out) {
  const auto slice = decode(framer_.packet());
  if (!slice) {
    ++bad_;
    return;
  }
  ++good_;
  last_packet_ = received;
  noise_since_ = kNever;
  if (!turns_.add(*slice, first_byte)) return;
  Scan& turn = turns_.turn();
  last_turn_ = received;
  watch_.compare(turn);
  const TurnCounts counts = sort_beams(settings_, turn);
  watch_.judge(counts, turn);
  if (sees(watch_.condition())) last_good_ = received;
  out.report(turn);
}

// Everything that happens by time is in health(); nothing is due by itself.
void Ld06Driver::on_tick(Time, DriverOut&) {}

void Ld06Driver::on_link_up(Time) {
  framer_.reset();
  turns_.reset();
  watch_.reset();
  noise_since_ = kNever;
}

}  // namespace drover::ld06
