// Process data objects: which values a node sends and takes by itself, and the steps that set it
// up. Source: CiA 301, sections 7.2.2 and 7.5.2.35 to 7.5.2.38.
#pragma once

#include "drivers/canopen/setup.h"

namespace drover::canopen {

struct MappedObject {
  Object object;
  std::uint8_t bits = 32;
};

/// From the node's side: it receives commands, it transmits feedback.
enum class PdoDirection : std::uint8_t { receives, transmits };

inline constexpr std::uint8_t kPdoByEvent = 255;

/// One of the four PDOs each way that have an id of their own.
struct Pdo {
  PdoDirection direction = PdoDirection::receives;
  std::uint8_t number = 1;  ///< 1 to 4
  /// 0: with the next SYNC when something changed, 1 to 240: with each n-th SYNC, 254 and 255: at
  /// an event, and what is received acts at once.
  std::uint8_t transmission = kPdoByEvent;
  std::optional<std::uint16_t> inhibit_100us;
  std::optional<std::uint16_t> event_timer_ms;  ///< some makers count in another unit: see theirs
  FixedVector<MappedObject, 8> objects;
};

using PdoSteps = FixedVector<SdoStep, 16>;

/// 180, 280, 380, 480 and 200, 300, 400, 500, each with the node.
std::uint32_t cob_id(const Pdo& pdo, std::uint8_t node);

/// In the order that CiA 301 asks for: invalid, then its kind and its objects, then valid again. In
/// the state pre-operational.
PdoSteps steps_of(const Pdo& pdo, std::uint8_t node);

}  // namespace drover::canopen
