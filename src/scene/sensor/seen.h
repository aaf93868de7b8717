// What the scanners of a robot say together of the field before it, as long as that is true.
#pragma once

#include <span>

#include "drover/driver.h"
#include "drover/fixed_text.h"
#include "drover/time.h"
#include "scene/sensor/field.h"

namespace drover::scene::sensor {

/// Of one scanner: its latest turn against the field, and its driver's word.
struct ScanSeen {
  Name device;
  SourceState state = SourceState::never_heard;
  Reason reason;  ///< why it is not fresh, or what is odd; empty when all is well
  // Of the turn; kNever: there was none.
  Time begin = kNever;  ///< its first point was measured
  Time end = kNever;    ///< its last
  FieldState field;
};

/// Three turns at 10 Hz. What is older says nothing of the present.
inline constexpr Duration kOldestTurn = std::chrono::milliseconds(300);

struct FieldView {
  FieldState field;
  Time since = kNever;  ///< the oldest point that it is made of was measured then
  Name scanner;         ///< that sees what is nearest, when it is blocked
  Reason unknown;       ///< why part of it is not seen, and by which scanner; empty: all is seen
};

/// Every scanner has to be well: one that is not may have seen what the others cannot, being lower
/// or higher. One of them has to see the whole field. What any of them sees in it is there.
/// Without a scanner nothing is seen.
FieldView view(std::span<const ScanSeen> scanners, Time now);

}  // namespace drover::scene::sensor
