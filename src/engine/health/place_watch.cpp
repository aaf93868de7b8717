// Whether the place changes while the wheels stand.
#include "engine/health/place_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drover/angle.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

// More than this, beyond what both places are uncertain by (two sigma each).
constexpr double kMoved_m = 0.1;
const double kSwung_rad = to_rad(5.0);
constexpr double kBetterKnown = 0.9;
constexpr Duration kStable = std::chrono::seconds(10);
// A busy computer hears nothing for so long, while the receiver may be believed elsewhere. Who is
// pushed without power is silent for longer.
constexpr Duration kHush = std::chrono::seconds(2);
// From one fix to the next, when these are not longer apart than those of any receiver.
constexpr double kPushed_mps = 1.0;
constexpr double kPushed_radps = 1.0;
constexpr Duration kNextFix = std::chrono::milliseconds(1200);

/// In steps that are not written anew in each cycle; upwards, and nothing of what is always there.
std::uint16_t whole_cm(double away_m) {
  constexpr double kStep_cm = 5;
  const double steps = std::ceil(std::min(100 * away_m, 60000.0) / kStep_cm);
  return away_m * 100 < kStep_cm ? std::uint16_t{0} : static_cast<std::uint16_t>(steps * kStep_cm);
}

struct Change {
  double way_m = 0;
  double turn_rad = 0;
  double way_share = 0;   ///< of what is no jump
  double turn_share = 0;  ///< of what is no jump
};

Change change(const Pose& from, const Pose& to) {
  Change it;
  it.way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  it.turn_rad = std::abs(wrap_rad(to.yaw_rad - from.yaw_rad));
  it.way_share = it.way_m / (kMoved_m + 2 * std::hypot(from.position_sigma_m, to.position_sigma_m));
  it.turn_share = it.turn_rad / (kSwung_rad + 2 * std::hypot(from.yaw_sigma_rad, to.yaw_sigma_rad));
  return it;
}

const Change& lesser_way(const Change& a, const Change& b) {
  return b.way_share < a.way_share ? b : a;
}

}  // namespace

void PlaceWatch::begin_at(const Pose& pose) {
  known_ = true;
  away_ = false;
  seen_ = rested_ = {pose, pose, pose};
  crept_x_m_ = crept_y_m_ = 0;
}

void PlaceWatch::recall(const RestPlace& place) {
  recalled_ = place;
  doubted_before_ = place.doubted;
  doubt_cm_ = place.doubt_cm;
  if (doubted_before_)
    jumped_ =
        "position or heading were not believed when droverd ended; if the map shows the robot "
        "where it stands: drover position accept";
}

void PlaceWatch::begin_where_it_stood(const GeodeticPoint& origin) {
  const RestPlace place = std::exchange(recalled_, {});
  if (place.origin_latitude_deg != origin.latitude_deg ||
      place.origin_longitude_deg != origin.longitude_deg)
    return;
  Pose pose;
  pose.x_m = place.x_m;
  pose.y_m = place.y_m;
  pose.yaw_rad = place.yaw_rad;
  pose.position_sigma_m = place.position_sigma_m;
  pose.yaw_sigma_rad = place.yaw_sigma_rad;
  begin_at(pose);
  away_ = true;
}

RestPlace PlaceWatch::rest_place(const GeodeticPoint& origin) const {
  if (recalled_.known) return recalled_;
  const bool doubted = doubted_ || doubted_before_;
  if (!known_ || !stands_) return {.doubted = doubted, .doubt_cm = doubt_cm_};
  // Whole centimetres: what creeps is not written anew in each cycle.
  const auto crept = [](double m) { return std::round(m * 100) / 100; };
  const Pose& pose = jumped_.empty() ? rested_.at : rested_.stood;
  return {.known = true,
          .doubted = doubted,
          .doubt_cm = doubt_cm_,
          .x_m = pose.x_m + crept(crept_x_m_),
          .y_m = pose.y_m + crept(crept_y_m_),
          .yaw_rad = pose.yaw_rad,
          .position_sigma_m = pose.position_sigma_m,
          .yaw_sigma_rad = pose.yaw_sigma_rad,
          .origin_latitude_deg = origin.latitude_deg,
          .origin_longitude_deg = origin.longitude_deg};
}

void PlaceWatch::update(Time now, Duration dt, const Estimate& estimate, WheelsHeard wheels,
                        const GeodeticPoint& origin) {
  const bool heard = wheels.some;
  missed_ = wheels.missed;
  // What rolls out after an e-stop rolls unheard.
  stands_ = heard && estimate.fastest_mps <= kStands_mps;
  // What stood before a moment of silence is compared after it with where it stood.
  const bool hush = !heard && stood_ && now - heard_at_ <= kHush;
  if (heard) {
    heard_at_ = now;
    stood_ = stands_;
  }
  doubted_ = estimate.place_doubted || estimate.heading_doubted;
  doubt_cm_ = whole_cm(estimate.elsewhere_m);
  if (heard && !stands_) recalled_ = {};
  if (!estimate.has_position || !estimate.has_heading || (recalled_.known && !heard)) return;
  if (recalled_.known) begin_where_it_stood(origin);
  // It was known that it may be elsewhere, and now that it is.
  const bool renewed = estimate.renewed != renewed_;
  renewed_ = estimate.renewed;
  Pose pose = estimate.pose;
  // What its wheels may have slipped before it came to rest without a fix is no jump, either.
  pose.position_sigma_m = std::hypot(pose.position_sigma_m, estimate.unseen_slip_m / 2);
  const bool well = !estimate.disagrees && estimate.looks.empty() &&
                    estimate.predicted_error_m <= config_.bound_run_m;
  if (renewed || !known_ || (heard && !stands_)) {
    unheard_ = false;
    followed_at_ = well ? now : kNever;
    followed_ = pose;
  } else if (well) {
    follow(now, pose, heard);
  }
  unheard_ = unheard_ || !heard;
  if (known_ && hush && !renewed) return;
  if (!known_ || !stands_ || renewed) return begin_at(pose);
  if (estimate.body.known) {
    const double way_m = estimate.body.twist.vx_mps * std::max(to_s(dt), 0.0);
    const double left_m = estimate.body.twist.vy_mps * std::max(to_s(dt), 0.0);
    const double c = std::cos(estimate.pose.yaw_rad);
    const double s = std::sin(estimate.pose.yaw_rad);
    crept_x_m_ += way_m * c - left_m * s;
    crept_y_m_ += way_m * s + left_m * c;
  }
  // What is suspected already is judged by who looks at it.
  const bool believed = !estimate.disagrees && estimate.looks.empty();
  if (believed && estimate.predicted_error_m <= config_.bound_run_m) compare(now, pose);
}

Pose PlaceWatch::without_creep(Pose pose) const {
  pose.x_m -= crept_x_m_;
  pose.y_m -= crept_y_m_;
  return pose;
}

void PlaceWatch::compare(Time now, const Pose& pose) {
  const Pose rested = without_creep(pose);
  const Change since = lesser_way(change(seen_.at, pose), change(rested_.at, rested));
  const Change in_all = lesser_way(change(seen_.began, pose), change(rested_.began, rested));
  const bool jumped =
      std::max({since.way_share, since.turn_share, in_all.way_share, in_all.turn_share}) > 1;
  if (jumped && !doubted_before_) {
    tell(pose);
    jumped_at_ = now;
    told_ = false;
  }
  away_ = false;
  if (!jumped && pose.position_sigma_m >= kBetterKnown * seen_.at.position_sigma_m) return;
  seen_.at = pose;
  rested_.at = rested;
  if (!jumped) return;
  seen_.began = pose;
  rested_.began = rested;
}

/// A pose that is well known. Between fixes nothing is known of who may be pushed.
void PlaceWatch::follow(Time now, const Pose& pose, bool heard) {
  const bool looks_back = (unheard_ || !heard) && followed_at_ != kNever;
  const bool fix = pose.position_sigma_m < sigma_m_;  // or a heading, which tells as much
  sigma_m_ = pose.position_sigma_m;
  if (looks_back && !fix) return;
  const Change since = change(followed_, pose);
  const Duration gap = now - followed_at_;
  const double pushed_s = looks_back && gap <= kNextFix ? to_s(gap) : 0.0;
  const double more_m = since.way_m - kPushed_mps * pushed_s;
  const double more_rad = since.turn_rad - kPushed_radps * pushed_s;
  const bool jumped =
      more_m * since.way_share > since.way_m || more_rad * since.turn_share > since.turn_rad;
  if (looks_back && jumped && !doubted_before_) {
    if (since.way_share > since.turn_share) {
      jumped_.format("the position jumped by %.1f m while no wheel was heard", since.way_m);
    } else {
      jumped_.format("the heading jumped by %.0f degrees while no wheel was heard",
                     to_deg(since.turn_rad));
    }
    jumped_at_ = now;
    told_ = false;
  }
  followed_ = pose;
  followed_at_ = now;
  if (heard) unheard_ = false;
}

/// Who was carried went through many places: what counts is how far in all. Who came back was away.
void PlaceWatch::tell(const Pose& pose) {
  const Pose rested = without_creep(pose);
  const Change last = lesser_way(change(seen_.at, pose), change(rested_.at, rested));
  const Change all = lesser_way(change(seen_.stood, pose), change(rested_.stood, rested));
  const char* how = away_     ? "while droverd was not running"
                    : missed_ ? "though no wheel that is heard turned"
                              : "though no wheel turned";
  if (std::max(last.way_share, all.way_share) > std::max(last.turn_share, all.turn_share)) {
    jumped_.format("the position jumped by %.1f m %s", std::max(last.way_m, all.way_m), how);
  } else {
    jumped_.format("the heading jumped by %.0f degrees %s",
                   to_deg(std::max(last.turn_rad, all.turn_rad)), how);
  }
}

Reason PlaceWatch::ask_start(Time now) {
  if (jumped_.empty() || doubted_before_) return jumped_;
  const bool stable = now - jumped_at_ >= kStable;
  if (stable && told_) {
    jumped_.clear();
    return {};
  }
  told_ = true;
  Reason why;
  why.format("%.*s: look where it stands, then start it again%s",
             static_cast<int>(jumped_.view().size()), jumped_.view().data(),
             stable ? "" : ", 10 s after the jump at the earliest");
  return why;
}

}  // namespace drover::engine
