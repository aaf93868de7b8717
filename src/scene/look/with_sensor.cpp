#include "scene/look/with_sensor.h"

#include <algorithm>
#include <string_view>

#include "scene/look/look.h"

namespace drover::scene {
namespace {

void take_all(Clearance& found) {
  found.along_m = found.ahead_m = found.back_m = 0;
  found.left_rad = found.right_rad = 0;
  found.bare = {};
}

}  // namespace

Clearance with_sensor(Clearance found, const sensor::FieldView& seen, const SensorTerms& terms) {
  if (seen.field.blocked) {
    const double left_m = seen.field.free_m - terms.driven_m - terms.margin_m;
    const double free_m = left_m > 0 ? left_m : 0;  // and what is no number is none
    const auto who = seen.scanner.empty() ? std::string_view("a scanner") : seen.scanner.view();
    const bool on_track = found.path != 0;
    const bool ahead = shorten(found.ahead_m, found.bare.ahead_m, free_m);
    const bool along =
        on_track && terms.track_ahead && shorten(found.along_m, found.bare.along_m, free_m);
    if (on_track ? along : ahead && found.twist.vx_mps >= 0 && !is_turn(found.twist))
      found.first.format("%.*s sees something, %.2f m ahead", static_cast<int>(who.size()),
                         who.data(), free_m);
  }
  if (!seen.field.unknown) return found;
  if (found.unknown.empty()) found.unknown = seen.unknown;
  if (found.unknown.empty()) found.unknown = "a scanner does not see all of its field";
  take_all(found);
  return found;
}

}  // namespace drover::scene
