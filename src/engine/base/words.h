// What people are told of a base: of its wheels, or of a device that tells for all of it.
#pragma once

#include "drover/fixed_text.h"
#include "engine/base/kinematics.h"

namespace drover::engine {

struct BaseWords {
  const char* wheels;        ///< who tells how it moves
  const char* are_silent;    ///< with who
  const char* tell_rest;     ///< with who
  const char* turn_by;       ///< with who, before a speed
  const char* do_not_move;   ///< with who
  const char* by;            ///< whose account it is
  const char* turned;        ///< likewise, before a turn
  const char* rolled;        ///< with who, before a way
  const char* wrong_turn;    ///< a question about a turn that others tell otherwise
  const char* wrong_way;     ///< about a way that others tell the other way round
  const char* short_way;     ///< about more than others tell
  const char* long_way;      ///< about less than others tell
  const char* no_swing;      ///< about a turn that was asked for and did not happen
  const char* on_first_way;  ///< about what works against itself
};

inline constexpr BaseWords kWheelWords{
    .wheels = "the wheels",
    .are_silent = "the wheels are silent",
    .tell_rest = "the wheels say that it rests",
    .turn_by = "the wheels turn by",
    .do_not_move = "the wheels do not move",
    .by = "by its wheels",
    .turned = "by its wheels it turned",
    .rolled = "the wheels rolled",
    .wrong_turn = "sides swapped, or a wheel reversed?",
    .wrong_way = "drives reversed, the heading turned round, or gear ratio wrong?",
    .short_way = "wheels slip, or gear ratio or wheel radius is wrong?",
    .long_way = "gear ratio or wheel radius is wrong?",
    .no_swing = "do the wheels slip or work against each other, or is the gyro wrong?",
    .on_first_way = "sides swapped, or a wheel reversed?",
};

inline constexpr BaseWords kTwistWords{
    .wheels = "the base",
    .are_silent = "the base is silent",
    .tell_rest = "the base says that it rests",
    .turn_by = "the base says",
    .do_not_move = "the base does not move",
    .by = "by its own word",
    .turned = "by its own word it turned",
    .rolled = "by its own word it went",
    .wrong_turn = "is the sign or the scale of its turn right?",
    .wrong_way = "is the sign of its speed right, or the heading turned round?",
    .short_way = "it slips, or the scale of its speed is wrong?",
    .long_way = "the scale of its speed is wrong?",
    .no_swing = "does it turn as it is told to, and is the gyro right?",
    .on_first_way = "does it tell its turn the right way round?",
};

inline const BaseWords& words_of(const Kinematics& base) {
  return takes_twist(base) ? kTwistWords : kWheelWords;
}

/// "wheel left"; of a base that takes a twist its device, or one of its edges: "the base".
inline FixedText<80> joint_text(const Kinematics& base, std::string_view joint) {
  FixedText<80> text;
  if (takes_twist(base))
    text = "the base";
  else
    text.format("wheel %.*s", static_cast<int>(joint.size()), joint.data());
  return text;
}

}  // namespace drover::engine
