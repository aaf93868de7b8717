// The table of devices, and of the links that they hang on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "config/config.h"
#include "drover/driver.h"
#include "drover/registry.h"
#include "engine/environment.h"
#include "gateway/input.h"

namespace drover::gateway {

struct Link {
  Name name;  ///< as people know it
  Wire wire = Wire::can;
  std::vector<SlotId> slots;  ///< in the order of the table
  std::size_t place = 0;      ///< in the configuration's table
  Reason lost{};              ///< a line of bytes: why it is gone; empty: it is not
};

/// One device in its place.
struct Slot {
  /// Who asks it: the control thread with all that it hears, or a thread that polls it slowly.
  enum class Thread : std::uint8_t { control, slow };

  // What every message touches lies together: of many devices it all stays in the cache.
  Made made;
  std::uint64_t overflows = 0;  ///< what it said and found no room
  LinkId link = 0;
  std::uint8_t source =
      0;  ///< of receivers, inertial sensors and batteries: its number of its kind
  SlotKind kind = SlotKind::drive;
  Name name;
  Thread thread = Thread::control;
  /// Of what moves something: its joints, by channel. What takes the base's twist is
  /// kBaseAxis.
  FixedVector<AxisId, kMaxChannels> axes;
  bool takes_twist = false;  ///< its one channel is the base
  bool of_base = true;       ///< of what moves something: the base, or else an arm, a mast
  SourceHealth health;       ///< as of the last cycle
  Time last_heard = kNever;  ///< on a bus: any frame of its device, understood or not
  /// Where the engine looks for it.
  FixedVector<SourceHealth*, kMaxChannels> tells_health;
  std::size_t place = 0;  ///< in the configuration's table
};

/// Links and slots by their numbers, which follow the order of the configuration's tables; but the
/// buses are the first links, and the drives the first slots.
struct Wiring {
  std::vector<Link> links;
  std::vector<Slot> slots;
};

/// Everything on which a device hangs, but scanners; the healths are put into `environment`. Throws
/// std::runtime_error naming the key that cannot be.
Wiring wire_up(const config::DroverConfig& config, engine::Environment& environment);

}  // namespace drover::gateway
