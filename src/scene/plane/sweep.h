// How far a footprint goes along its way before it touches something.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "scene/plane/field.h"
#include "scene/plane/steps.h"

namespace drover::scene {

inline constexpr std::size_t kNoObject = std::numeric_limits<std::size_t>::max();
/// A contact is known to this length of the way that any corner of the footprint makes.
inline constexpr double kResolution_m = 0.01;

/// What a sweep found. All of it is of the last pose that is reached without contact.
struct FreeWay {
  double free_m = 0;    ///< driven until there
  double free_rad = 0;  ///< turned until there
  Pose2 pose;
  bool blocked = false;    ///< something ends the way; else the whole of it is free
  bool at_start = false;   ///< it is there already at the first pose
  std::size_t object = 0;  ///< when blocked: index of the first one; kNoObject: no numbers to judge
  Point2 where;            ///< when blocked: the object's point that is nearest to the footprint
};

/// All that the footprint (in base_link) passes on an arc from one pose to the other, the shorter
/// way round: the convex hull of both and the sagitta of the longest arc around it.
Piece swept(const Piece& footprint, const Pose2& from, const Pose2& to);

/// The first object along the way; of several within the resolution the first by name. Nothing
/// slips through between two steps.
FreeWay first_contact(const Field& field, const Piece& footprint, std::span<const Step> steps);

/// Where the footprint as a whole is no more inside one of the keep-in zones (their areas by
/// area_of_rings); `object` is the zone that it was in (0 if in none). No zones at all: no bound.
FreeWay first_exit(std::span<const Area> keep_in, const Piece& footprint,
                   std::span<const Step> steps);

}  // namespace drover::scene
