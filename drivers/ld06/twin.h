// A simulated LD06: measures a world that somebody else knows, and says so at the device's pace.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/ld06/codec.h"
#include "drivers/noise.h"
#include "drover/time.h"
#include "drover/twin.h"

namespace drover::ld06 {

/// States of set_state(); each replaces the one before:
///   ""            well
///   covered       a cap: a ring of four centimetres
///   dark          nothing comes back
///   frozen        the same turn over and over
///   sun           three of ten beams come back
///   noise         one of twenty beams has a range that is not there
///   dirty         a spot of 40 degrees on the lens, to the left
///   stuck         its motor stands, it goes on sending
///   silent        no bytes
///   turn:<Hz>     its motor turns at this pace, 1 to 20
class Ld06Twin final : public ScannerTwin {
 public:
  /// `upside_down` as the driver's; `seed` is the only source of its randomness.
  Ld06Twin(bool upside_down, std::uint64_t seed);

  std::size_t on_tick(Time now, const RangeOf& range_of, std::span<char> out) override;
  bool set_state(std::string_view name, Time now) override;

 private:
  enum class Fault : std::uint8_t {
    none,
    covered,
    dark,
    frozen,
    sun,
    noise,
    dirty,
    stuck,
    silent,
    turn
  };

  Slice measure(const RangeOf& range_of, Time at);
  Beam beam(const RangeOf& range_of, double clockwise_rad);
  Beam beam_at(double range_m);

  bool upside_down_;
  Random random_;
  Fault fault_ = Fault::none;
  double turn_Hz_ = kTurn_Hz;
  Time start_ = kNever;
  std::int64_t packets_ = 0;  ///< since start_
  std::size_t beam_ = 0;      ///< of the turn
  std::vector<Beam> turn_;    ///< what was measured last, by the place in the turn
};

}  // namespace drover::ld06
