// What is wrong with an estimate, in words: why it is not good, what it waits for, what is made up
// for.
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/contradictions.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

using namespace estimate;

Contradictions estimate::contradictions_of(const State& state, Duration patience, Time now) {
  const Dispute& dispute = state.gnss.dispute;
  Contradictions between;
  between.disputed = dispute.holds() && now - dispute.since() >= patience;
  between.position = between.disputed || state.gnss.jumps.disagrees(patience);
  between.heading = state.heading.jumps.disagrees(patience);
  between.stuck = state.watch.stuck(now, patience);
  between.drifted = state.watch.drifted;
  return between;
}

namespace {

constexpr const char* kAccept =
    "; if the map shows the robot where it stands: drover position accept";

Reason place_reason(const Contradictions& between, const Dispute& dispute) {
  Reason why = "position disagrees with odometry";
  if (between.disputed)
    why.format("position disagrees with odometry by %.2f m%s", dispute.apart_m() + dispute.led_m(),
               kAccept);
  return why;
}

Reason heading_reason(const HeadingTrack& heading, bool with_gyro) {
  Reason why = "heading disagrees with odometry";
  if (heading.jumps.began_moving())
    why.format("heading disagrees with odometry: %.0f degrees beside %s",
               to_deg(heading.contradiction_rad), with_gyro ? "gyro and wheels" : "wheels");
  return why;
}

/// Of those at once the one that a person has to know first; empty: none.
Reason reason_of(const State& state, const Contradictions& between, bool with_gyro) {
  const MotionWatch& watch = state.watch;
  Reason why;
  if (between.stuck)
    why.format("wheels slip or the receiver is stuck: %.2f m/s by wheels, %.2f by receiver",
               watch.wheel_mps, watch.receiver_mps);
  else if (between.position)
    why = place_reason(between, state.gnss.dispute);
  else if (between.heading)
    why = heading_reason(state.heading, with_gyro);
  else if (between.drifted)
    why.format("position drifts away from odometry: %.2f m%s", watch.drift_m, kAccept);
  return why;
}

/// What is made up for so far. `disputed`: why it is, while it is.
Reason notice_of(const State& state, const Reason& disputed) {
  const MotionWatch& watch = state.watch;
  const double apart_degps = to_deg(std::abs(state.gyro.apart_radps));
  Reason notice = disputed;
  switch (state.gyro.trouble) {
    case TurnTrouble::none:
      if (watch.slipping())
        notice.format("wheels slip: %.2f m/s by wheels, %.2f m/s by receiver", watch.wheel_mps,
                      watch.receiver_mps);
      break;
    case TurnTrouble::slip:
      notice.format("wheels slip in the turn: %.1f degrees/s apart from the gyro", apart_degps);
      break;
    case TurnTrouble::gyro:
      notice.format("gyro not believed: %.1f degrees/s apart from wheels and receiver",
                    apart_degps);
      break;
    case TurnTrouble::undecided:
      notice.format("gyro and wheels contradict each other: %.1f degrees/s apart", apart_degps);
      break;
    case TurnTrouble::pushed:
      notice.format("the base turns by %.1f degrees/s while its wheels stand", apart_degps);
      break;
  }
  return notice;
}

Reason look_of(const MotionWatch& watch) {
  Reason text;
  const bool along = watch.look.along;
  text.format("stands and looks whether the position drifts: %.2f m %s",
              along ? watch.unseen_slip_m : watch.gap_m,
              along ? "apart from the wheels along the way, which may have slipped"
                    : "beside wheels and heading");
  return text;
}

}  // namespace

/// Why there is no place yet; empty: there is one.
const char* Estimator::missing(const State& state, Time now) const {
  if (!frame_.has_origin()) return "no origin";
  if (!state.has_position) return "no position yet";
  if (!state.has_heading) return "no heading";
  if (body_motion(base_, state.told, now, wheel_stale_).known) return "";
  return takes_twist(base_) ? "the base is silent" : "wheels are silent";
}

void Estimator::report_trouble(const State& state, const Contradictions& between, Time now) {
  Estimate& e = estimate_;
  const MotionWatch& watch = state.watch;
  e.disagrees = between.any();
  e.disputed = e.disagrees && !between.stuck && !between.drifted &&
               (!between.position || between.disputed) &&
               (!between.heading || state.heading.jumps.began_moving());
  e.place_doubted = between.disputed || between.drifted;
  e.heading_doubted = between.heading;
  e.renewed = state.gnss.renewed;
  e.found = state.gnss.found;
  e.decided_at = between.disputed ? state.gnss.dispute.decided_at() : kNever;
  e.slipped_m = watch.slipping() ? watch.slipped_m + std::abs(watch.last_gap_m) : 0;
  e.slipping = watch.slipping() || state.gyro.trouble == TurnTrouble::slip ||
               state.gyro.trouble == TurnTrouble::undecided;

  e.reason = e.disagrees ? reason_of(state, between, e.gyro_used) : Reason(missing(state, now));
  e.looks = watch.looks() && !e.disagrees ? look_of(watch) : Reason();
  e.notice = notice_of(state, e.disputed ? e.reason : Reason());
}

}  // namespace drover::engine
