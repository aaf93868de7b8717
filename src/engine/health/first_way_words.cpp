// Each names the two accounts, and asks for what is usually behind them.
#include "engine/health/first_way_words.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

FixedText<100> names_of_axle(const EngineConfig& config, std::size_t axle) {
  const std::string_view left = config.joints[config.base.left[axle]].view();
  const std::string_view right = config.joints[config.base.right[axle]].view();
  FixedText<100> both;
  both.format("%.*s/%.*s", static_cast<int>(left.size()), left.data(),
              static_cast<int>(right.size()), right.data());
  return both;
}

/// What a turn that did not come may be for. Axles that work against each other turn nothing, and
/// which of the two it is nobody sees.
Reason why_no_turn(const EngineConfig& config) {
  if (config.base.left.size() != 2 || config.base.right.size() != 2)
    return words_of(kinematics_of(config.base)).no_swing;
  const FixedText<100> front = names_of_axle(config, 0);
  const FixedText<100> rear = names_of_axle(config, 1);
  Reason why;
  why.format("are the sides swapped on one axle (%.*s or %.*s)?",
             static_cast<int>(front.view().size()), front.view().data(),
             static_cast<int>(rear.view().size()), rear.view().data());
  return why;
}

}  // namespace

Reason odd_turn(const BaseWords& words, const TurnAccounts& turn) {
  const bool heading = std::isfinite(turn.receiver_rad);
  const bool gyro_is_odd = heading && std::abs(turn.receiver_rad - turn.wheels_rad) <
                                          std::abs(turn.receiver_rad - turn.gyro_rad);
  Reason why;
  if (gyro_is_odd) {
    why.format(
        "the gyro turned %+.0f degrees, %s %+.0f, the receiver %+.0f: is the IMU mounted as "
        "configured, and groups.base.track_m right?",
        to_deg(turn.gyro_rad), words.wheels, to_deg(turn.wheels_rad), to_deg(turn.receiver_rad));
  } else {
    why.format("%s the robot turned %+.0f degrees, by the %s %+.0f: %s", words.by,
               to_deg(turn.wheels_rad), heading ? "gyro and receiver" : "gyro",
               to_deg(turn.gyro_rad), words.wrong_turn);
  }
  return why;
}

Reason odd_turn_by_receiver(const BaseWords& words, double wheels_rad, double receiver_rad) {
  Reason why;
  why.format("%s the robot turned %+.0f degrees, by the receiver %+.0f: %s", words.by,
             to_deg(wheels_rad), to_deg(receiver_rad), words.wrong_turn);
  return why;
}

Reason odd_turn_by_places(const EngineConfig& config, double wheels_rad, double places_rad,
                          bool against) {
  const BaseWords& words = words_of(kinematics_of(config.base));
  const Reason cause = against ? Reason(words.wrong_turn) : why_no_turn(config);
  Reason why;
  why.format("%s %+.0f degrees, by where the receiver went %+.0f: %.*s", words.turned,
             to_deg(wheels_rad), to_deg(places_rad), static_cast<int>(cause.view().size()),
             cause.view().data());
  return why;
}

Reason no_swing(const EngineConfig& config, const NoSwing& swing) {
  const BaseWords& words = words_of(kinematics_of(config.base));
  const Reason cause = why_no_turn(config);
  const bool slips = swing.wheels_rad != 0;
  Reason why;
  why.format("%s %+.0f degrees, by the %s %+.0f: %.*s", slips ? words.turned : "asked to turn",
             to_deg(slips ? swing.wheels_rad : swing.asked_rad),
             swing.by_gyro ? "gyro" : "receiver", to_deg(swing.turned_rad),
             static_cast<int>(cause.view().size()), cause.view().data());
  return why;
}

Reason odd_way(const BaseWords& words, const WayAccounts& way) {
  Reason why;
  if (way.ahead_m * way.wheels_m < 0) {
    why.format("%s %+.2f m, the receiver went %+.2f m: %s", words.rolled, way.wheels_m, way.ahead_m,
               words.wrong_way);
  } else {
    why.format("%s %.2f m, the receiver went %.2f m: %s", words.rolled, std::abs(way.wheels_m),
               way.gone_m, way.is_short ? words.short_way : words.long_way);
  }
  return why;
}

}  // namespace drover::engine
