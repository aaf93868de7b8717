// What an operator is told when wheels, gyro and receiver do not agree on the first way.
#pragma once

#include "drover/measurement.h"
#include "drover/snapshot.h"
#include "engine/base/words.h"
#include "engine/config.h"

namespace drover::engine {

/// Of one turn, left positive.
struct TurnAccounts {
  double wheels_rad = 0;
  double gyro_rad = 0;
  double receiver_rad = kAbsent;  ///< it tells no heading
};

/// The gyro contradicts the wheels; whom the receiver contradicts is named.
Reason odd_turn(const BaseWords& words, const TurnAccounts& turn);
/// There is no gyro, and the receiver contradicts the wheels.
Reason odd_turn_by_receiver(const BaseWords& words, double wheels_rad, double receiver_rad);
/// By where the receiver went the base did not turn as the wheels say, but to the other side
/// (`against`), or not at all.
Reason odd_turn_by_places(const EngineConfig& config, double wheels_rad, double places_rad,
                          bool against);

/// A turn to one side that was asked for, and did not come.
struct NoSwing {
  double asked_rad = 0;
  double wheels_rad = 0;  ///< 0: they made next to nothing of it
  double turned_rad = 0;
  bool by_gyro = false;  ///< or else by the receiver
};
Reason no_swing(const EngineConfig& config, const NoSwing& swing);

/// Of one way.
struct WayAccounts {
  double wheels_m = 0;    ///< ahead positive
  double ahead_m = 0;     ///< by the receiver, in the base's direction
  double gone_m = 0;      ///< by the receiver, in any
  bool is_short = false;  ///< by the receiver it is less
};
Reason odd_way(const BaseWords& words, const WayAccounts& way);

}  // namespace drover::engine
