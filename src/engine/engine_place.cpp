// The engine's part of knowing the place: from where it counts, and a person's word for it.
#include <cmath>

#include "drover/angle.h"
#include "engine/engine_impl.h"

namespace drover::engine {
namespace {

bool valid(const GeodeticPoint& point) {
  return std::abs(point.latitude_deg) <= 90 && std::abs(point.longitude_deg) <= 180 &&
         std::isfinite(point.altitude_m);
}

}  // namespace

/// Why the receiver's last position is none that a place may be taken from.
Reason Engine::Impl::poor_fix(Time now) const {
  const Time at = snapshot.gnss.position_time;
  if (!health.report().gnss_ok || at == kNever || now - at > from_s(config.health.gnss_stale_s))
    return "the receiver gives no position";
  if (fix.quality != FixQuality::rtk_fixed) return "the position is not RTK fixed";
  if (fix.correction_age_s > config.estimate.max_correction_age_s)
    return "the corrections are too old";
  return {};
}

void Engine::Impl::propose_origin(const RequestId& id, Time now) {
  const auto refuse = [&](const Reason& why) { events.push(now, CommandRefused{id, why}); };
  if (navigator.active()) return refuse("a task runs: cancel it first");
  if (const Reason why = poor_fix(now); !why.empty()) return refuse(why);
  // Whoever counts from a place that is doubted has it for good.
  if (estimate.place_doubted) return refuse(estimate.reason);
  GeodeticPoint origin{fix.latitude_deg, fix.longitude_deg, fix.altitude_msl_m};
  if (std::isfinite(fix.undulation_m)) origin.altitude_m += fix.undulation_m;
  if (!std::isfinite(origin.altitude_m)) origin.altitude_m = 0;  // it only tilts the map
  if (!valid(origin)) return refuse("the receiver's position is not valid");
  events.push(now, OriginProposed{id, origin});
}

void Engine::Impl::set_origin(const RequestId& id, const GeodeticPoint& origin, Time now) {
  if (navigator.active()) {
    events.push(now, CommandRefused{id, "a task runs: cancel it first"});
  } else if (!valid(origin)) {
    events.push(now, CommandRefused{id, "the origin is not a place on earth"});
  } else {
    estimator.set_origin(origin);
    estimate = estimator.step(last_step == kNever ? now : last_step);
    place.forget();
    place_count.another();
    snapshot.origin_set = true;
    snapshot.origin = origin;
    events.push(now, CommandAccepted{id, {}});
  }
}

void Engine::Impl::accept_position(const RequestId& id, Time now) {
  const auto refuse = [&](const Reason& why) { events.push(now, CommandRefused{id, why}); };
  if (navigator.active()) return refuse("a task runs: cancel it first");
  if (!owners.at_rest() || rest.moves(now)) return refuse("the robot moves");
  if (!estimator.has_origin()) return refuse("there is no origin");
  if (const Reason why = poor_fix(now); !why.empty()) return refuse(why);
  if (!estimate.looks.empty()) return refuse(estimate.looks);
  estimator.accept_position();
  estimate = estimator.step(last_step == kNever ? now : last_step);
  // Who accepts it has seen where it jumped to.
  place = PlaceWatch(config.estimate);
  place_count.another();
  events.push(now, CommandAccepted{id, {}});
}

void Engine::Impl::forget_learned(const RequestId& id, Time now) {
  const auto refuse = [&](const Reason& why) { events.push(now, CommandRefused{id, why}); };
  if (navigator.active()) return refuse("a task runs: cancel it first");
  if (!owners.at_rest() || rest.moves(now)) return refuse("the robot moves");
  // The place is found anew, and what it is compared with is forgotten: that must be in order now.
  if (const Reason why = poor_fix(now); !why.empty()) return refuse(why);
  if (estimate.disagrees || estimate.place_doubted) return refuse(estimate.reason);
  if (!place.jumped().empty()) return refuse(place.jumped());
  if (!place.compared()) return refuse("where it stood before is not compared yet");
  if (!estimate.looks.empty()) return refuse(estimate.looks);
  estimator.forget_learned();
  estimate = estimator.step(last_step == kNever ? now : last_step);
  place.forget();
  place_count.another();
  learned_notices = {};
  events.push(now, CommandAccepted{id, {}});
}

}  // namespace drover::engine
