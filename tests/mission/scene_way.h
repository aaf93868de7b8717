// Along a track, by geometry of its own: how far a robot may go until its outline meets something,
// and how far it needs to stop.
#pragma once

#include <optional>
#include <vector>

#include "mission/judge.h"
#include "mission/track.h"

namespace drover::mission {

/// A polyline that is walked along.
class Way final {
 public:
  explicit Way(std::vector<Place> points);
  double length_m() const { return at_m_.empty() ? 0 : at_m_.back(); }
  /// `s_m` from the first point on, clamped; it looks where the track goes.
  TruePose pose(double s_m) const;
  /// The nearest place of the way to `at`, not before `from_m` and not farther on than `reach_m`.
  double nearest_m(const Place& at, double from_m, double reach_m) const;

 private:
  std::vector<Place> points_;
  std::vector<double> at_m_;
};

/// From `s_m` to where the outline first meets `thing`, looked at each centimetre as far as
/// `end_m`, so many metres beside the way all along; nothing: it never does.
std::optional<double> way_to_contact_m(const Way& way, double s_m, double end_m, double beside_m,
                                       const Flat& thing);
/// The nearest that the outline comes to it.
double nearest_on_way_m(const Way& way, double s_m, double end_m, double beside_m,
                        const Flat& thing);

}  // namespace drover::mission
