// What lamp, buzzer and enable relay show: patterns of the robot's state, for people near it.
#include "engine/signals/signals.h"

namespace drover::engine {
namespace {

using std::chrono::milliseconds;

bool flash(Duration age, milliseconds period, milliseconds on) {
  return age % period < on;
}

bool lamp(Mood mood, Duration age) {
  switch (mood) {
    case Mood::stopped:
      return age % milliseconds(1600) < milliseconds(900) &&
             flash(age % milliseconds(1600), milliseconds(300), milliseconds(150));
    case Mood::paused: return flash(age, milliseconds(250), milliseconds(125));
    case Mood::about:
    case Mood::moving: return true;
    case Mood::ready: return flash(age, milliseconds(2000), milliseconds(100));
  }
  return false;
}

bool in_motion(Mood mood) {
  return mood == Mood::about || mood == Mood::moving;
}

/// Two beeps when it begins to move, to their end though it moves meanwhile; a long one when it
/// was stopped.
bool buzzer(Mood mood, Duration age, Duration motion_age) {
  if (in_motion(mood)) {
    return motion_age < milliseconds(600) &&
           flash(motion_age, milliseconds(300), milliseconds(150));
  }
  return mood == Mood::stopped && age < milliseconds(800);
}

Mood mood_of(const Snapshot& snapshot, bool moving, bool armed) {
  if (snapshot.stop_latched || snapshot.nav.owner == Owner::estop || snapshot.guard_has_bus) {
    return Mood::stopped;
  }
  if (snapshot.nav.paused) return Mood::paused;
  if (moving) return Mood::moving;
  return armed ? Mood::about : Mood::ready;
}

}  // namespace

const std::array<bool, kOutputCount>& Signals::step(Time now, const Snapshot& snapshot, bool moving,
                                                    bool armed, bool power) {
  const Mood mood = mood_of(snapshot, moving, armed);
  if (since_ == kNever || mood != mood_) since_ = now;
  if (in_motion(mood) && (motion_since_ == kNever || !in_motion(mood_))) motion_since_ = now;
  mood_ = mood;
  const Duration age = now - since_;
  levels_[static_cast<std::size_t>(Output::lamp)] = lamp(mood, age);
  levels_[static_cast<std::size_t>(Output::buzzer)] = buzzer(mood, age, now - motion_since_);
  // Only what cuts the drives' power by intention: a base without power may roll down a slope.
  levels_[static_cast<std::size_t>(Output::enable_relay)] = power;
  return levels_;
}

}  // namespace drover::engine
