// What the LD06 driver says of its scanner, in words for an operator.
#include "drivers/ld06/driver.h"
#include "drover/angle.h"

namespace drover::ld06 {
namespace {

// A scanner that works sends 375 packets a second.
constexpr Duration kNoPacket = std::chrono::seconds(1);
// The slowest turn whose speed is worth telling.
constexpr Duration kNoTurn = std::chrono::seconds(1);

/// Words for what the latest turn was.
void explain_turn(const Watch& watch, const Settings& settings, Reason& reason) {
  const double blind_deg = to_deg(wrap_rad(watch.blind_bearing_rad() + settings.mount.yaw_rad));
  const bool blind =
      watch.condition() == Condition::blind || watch.condition() == Condition::partly_blind;
  if (blind && watch.points() < kLossyShare * watch.points_due()) {
    reason.format("of the scanner's turn %d of %d points arrive: its line loses packets",
                  watch.points(), watch.points_due());
    return;
  }
  switch (watch.condition()) {
    case Condition::turn_rate:
      reason.format("the scanner turns at %.1f Hz, %.0f expected: its supply, or something rubs",
                    watch.turn_Hz(), kTurn_Hz);
      break;
    case Condition::dark:
      reason = "the scanner gets nothing back: covered, or nothing within its reach";
      break;
    case Condition::ring:
      reason.format("the scanner sees something nearer than %.1f m all round: its lens is covered",
                    kRing_m);
      break;
    case Condition::own_only:
      reason = "the scanner sees nothing but the robot itself: covered, or self_filter is too wide";
      break;
    case Condition::frozen: reason = "the scanner tells the same turn over and over"; break;
    case Condition::blind:
      reason.format(
          "the scanner is blind in %d of %zu sectors: sun, fog, a dirty lens, or nothing "
          "within its reach",
          watch.blind_sectors(), settings.sectors);
      break;
    case Condition::partly_blind:
      reason.format("the scanner is blind in %d of %zu sectors, one at %.0f deg from ahead",
                    watch.blind_sectors(), settings.sectors, blind_deg);
      break;
    case Condition::dirty:
      reason = "the scanner sees more of the robot itself than it did: look for dirt on its lens";
      break;
    case Condition::well: break;
  }
}

}  // namespace

SourceHealth Ld06Driver::health(Time now) const {
  SourceHealth health;
  health.last_good = last_good_;
  health.good = good_;
  health.bad = bad_;
  // A turn in which nothing is seen is told as that, however young the one before it is: the robot
  // stops for it at once.
  const bool heard = last_good_ != kNever && now - last_good_ <= settings_.stale;
  if (heard && sees(watch_.condition())) {
    health.state = SourceState::fresh;
    explain_turn(watch_, settings_, health.reason);
  } else {
    health.state = last_good_ == kNever ? SourceState::never_heard : SourceState::stale;
    explain_silence(now, health.reason);
  }
  return health;
}

void Ld06Driver::explain_silence(Time now, Reason& reason) const {
  if (last_byte_ == kNever) {
    reason = "no data from the scanner";
  } else if (now - last_byte_ > settings_.stale) {
    reason.format("the scanner is silent for %.1f s", to_s(now - last_byte_));
  } else if (noise_since_ != kNever && now - noise_since_ >= kNoPacket) {
    reason.format("bytes but no packet at %.0f: baud, or another device?", settings_.baud);
  } else if (last_turn_ == kNever || now - last_turn_ > kNoTurn || sees(watch_.condition())) {
    reason = "the scanner sends but does not turn: its motor, or its supply";
  } else {
    explain_turn(watch_, settings_, reason);
  }
}

}  // namespace drover::ld06
