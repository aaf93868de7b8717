// Why a list of points is no track: the engine refuses it, and who looks along it does not begin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/fixed_text.h"
#include "drover/path.h"

namespace drover::track {

struct Flaw {
  enum class Kind : std::uint8_t {
    none,
    too_few,     ///< fewer than two points
    not_finite,  ///< `point` is no place
    far_apart,   ///< `point` is `gap_m` from the one before it
    one_place,   ///< all of them
    crowd        ///< those from `point` to `last`, at one place
  };
  Kind kind = Kind::none;
  std::size_t point = 0;  ///< index
  std::size_t last = 0;
  double gap_m = 0;
};

/// The first one; of crowds only where there is nothing worse. O(points), nothing allocates.
Flaw find_flaw(std::span<const PathPoint> points);

/// Why a path cannot be driven to point `target` (an index from 0); empty when it can. Points are
/// named as the operator counts, from 1. O(points).
Reason check_path(const Path& path, std::uint32_t target);

}  // namespace drover::track
