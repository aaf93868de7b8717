#include "gateway/recording/input_codec.h"

#include <algorithm>
#include <string>

#include "gateway/recording/text.h"

namespace drover::gateway {

namespace {

// One `put` and one `get` for each input, in the order of the variant.

void put_frame(const CanFrame& frame, ByteWriter& out) {
  out.number(frame.id);
  const unsigned flags = (frame.extended ? 1U : 0U) | (frame.remote ? 2U : 0U) |
                         (frame.fd ? 4U : 0U) | (frame.error ? 8U : 0U);
  out.byte(static_cast<std::uint8_t>(flags));
  out.blob(frame.payload());
}

CanFrame get_frame(ByteReader& in) {
  CanFrame frame;
  frame.id = static_cast<std::uint32_t>(in.below(std::uint64_t{1} << 32U));
  const auto flags = in.byte();
  frame.extended = (flags & 1U) != 0;
  frame.remote = (flags & 2U) != 0;
  frame.fd = (flags & 4U) != 0;
  frame.error = (flags & 8U) != 0;
  const auto data = in.blob();
  if (data.size() > frame.data.size() || flags > 15U) {
    in.fail();
    return {};
  }
  frame.len = static_cast<std::uint8_t>(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) frame.data[i] = data[i];
  return frame;
}

bool get_flag(ByteReader& in) {
  return in.below(2) != 0;
}

/// A damaged one must not make later arithmetic overflow: no machine runs for a century.
Time get_time(Time before, ByteReader& in) {
  constexpr std::uint64_t kCentury = 100ULL * 366 * 24 * 3600 * 1'000'000'000;
  const auto ns = static_cast<std::uint64_t>(before.time_since_epoch().count()) +
                  static_cast<std::uint64_t>(in.signed_number());
  if (ns > kCentury) {
    in.fail();
    return before;
  }
  return Time{Duration{static_cast<std::int64_t>(ns)}};
}

void put(const FrameHeard& heard, ByteWriter& out) {
  out.byte(heard.bus);
  put_frame(heard.frame, out);
}
void get(FrameHeard& heard, ByteReader& in) {
  heard.bus = in.byte();
  heard.frame = get_frame(in);
}

void put(const BytesHeard& heard, ByteWriter& out) {
  out.byte(heard.link);
  out.blob(heard.bytes);
}
void get(BytesHeard& heard, ByteReader& in) {
  heard.link = in.byte();
  heard.bytes = in.blob();
}

void put(const LevelsRead& read, ByteWriter& out) {
  out.byte(read.link);
  out.number(read.levels.size());
  for (const bool level : read.levels) out.byte(level ? 1 : 0);
}
void get(LevelsRead& read, ByteReader& in) {
  read.link = in.byte();
  const auto count = in.below(read.levels.capacity() + 1);
  for (std::uint64_t i = 0; i < count; ++i) (void)read.levels.push_back(get_flag(in));
}

void put(const RegistersRead& read, ByteWriter& out) {
  out.byte(read.slot);
  out.byte(read.block);
  out.number(read.words.size());
  for (const auto word : read.words) out.number(word);
}
void get(RegistersRead& read, ByteReader& in) {
  read.slot = in.byte();
  read.block = in.byte();
  const auto count = in.below(read.words.capacity() + 1);
  for (std::uint64_t i = 0; i < count && in.good(); ++i)
    (void)read.words.push_back(static_cast<std::uint16_t>(in.below(0x10000)));
}

void put(const RegistersFailed& failed, ByteWriter& out) {
  out.byte(failed.slot);
  out.byte(failed.block);
  out.byte(static_cast<std::uint8_t>(failed.failure));
  out.signed_number(failed.exception);
}
void get(RegistersFailed& failed, ByteReader& in) {
  failed.slot = in.byte();
  failed.block = in.byte();
  failed.failure =
      static_cast<RegisterFailure>(in.below(static_cast<unsigned>(RegisterFailure::link) + 1));
  failed.exception = static_cast<std::uint8_t>(in.signed_number());
}

void put(const LinkUp& up, ByteWriter& out) {
  out.byte(up.link);
}
void get(LinkUp& up, ByteReader& in) {
  up.link = in.byte();
}

void put(const LinkLost& lost, ByteWriter& out) {
  out.byte(lost.link);
  out.text(lost.why);
}
void get(LinkLost& lost, ByteReader& in) {
  lost.link = in.byte();
  lost.why.assign(in.text());
}

void put(const FramesSent& counts, ByteWriter& out) {
  out.byte(counts.bus);
  out.number(counts.sent);
  out.number(counts.refused);
}
void get(FramesSent& counts, ByteReader& in) {
  counts.bus = in.byte();
  counts.sent = in.number();
  counts.refused = in.number();
}

void put(const Tick& tick, ByteWriter& out) {
  out.byte(static_cast<std::uint8_t>((tick.guard_alive ? 1U : 0U) | (tick.guard_has_bus ? 2U : 0U) |
                                     (tick.guard_latched ? 4U : 0U) |
                                     (tick.guard_refuses_set ? 8U : 0U) |
                                     (tick.guard_has_all ? 16U : 0U)));
}
void get(Tick& tick, ByteReader& in) {
  const auto bits = in.below(32);
  tick.guard_alive = (bits & 1U) != 0;
  tick.guard_has_bus = (bits & 2U) != 0;
  tick.guard_latched = (bits & 4U) != 0;
  tick.guard_refuses_set = (bits & 8U) != 0;
  tick.guard_has_all = (bits & 16U) != 0;
}

void put(const ProgramTrouble& trouble, ByteWriter& out) {
  out.text(trouble.why);
}
void get(ProgramTrouble& trouble, ByteReader& in) {
  trouble.why.assign(in.text());
}

void put(const Suspended& slept, ByteWriter& out) {
  out.real(slept.lasted_s);
}
void get(Suspended& slept, ByteReader& in) {
  slept.lasted_s = in.real();
}

void put(const HeldUp& held_up, ByteWriter& out) {
  out.real(held_up.lasted_s);
}
void get(HeldUp& held_up, ByteReader& in) {
  held_up.lasted_s = in.real();
}

// Of the place where it rests; recordings from before doubts were kept have none.
constexpr std::uint8_t kPlaceKnown = 1;
constexpr std::uint8_t kPlaceDoubted = 2;
constexpr std::uint8_t kPlaceHowFar = 4;

void put(const Recalled& recalled, ByteWriter& out) {
  const auto& [stop, stop_at_robot, power_cut, holding, released, task, proved, joints_wait,
               at_rest, ran_away, place] = recalled.remembered;
  out.text(stop);
  for (const bool flag : {stop_at_robot, power_cut, holding, released, task, proved})
    out.byte(flag ? 1 : 0);
  out.text(joints_wait);
  out.byte(at_rest ? 1 : 0);
  out.byte(ran_away ? 1 : 0);
  const auto& [known, doubted, doubt_cm, x_m, y_m, yaw_rad, position_sigma_m, yaw_sigma_rad,
               latitude_deg, longitude_deg] = place;
  out.byte(static_cast<std::uint8_t>((known ? kPlaceKnown : 0) | (doubted ? kPlaceDoubted : 0) |
                                     (doubt_cm > 0 ? kPlaceHowFar : 0)));
  if (doubt_cm > 0) out.real(doubt_cm);
  if (!known) return;
  for (const double value :
       {x_m, y_m, yaw_rad, position_sigma_m, yaw_sigma_rad, latitude_deg, longitude_deg})
    out.real(value);
}
void get(Recalled& recalled, ByteReader& in) {
  auto& [stop, stop_at_robot, power_cut, holding, released, task, proved, joints_wait, at_rest,
         ran_away, place] = recalled.remembered;
  stop.assign(in.text());
  for (bool* flag : {&stop_at_robot, &power_cut, &holding, &released, &task, &proved})
    *flag = get_flag(in);
  joints_wait.assign(in.text());
  at_rest = get_flag(in);
  ran_away = get_flag(in);
  auto& [known, doubted, doubt_cm, x_m, y_m, yaw_rad, position_sigma_m, yaw_sigma_rad, latitude_deg,
         longitude_deg] = place;
  const std::uint8_t flags = in.byte();
  if (flags > (kPlaceKnown | kPlaceDoubted | kPlaceHowFar)) in.fail();
  if ((flags & kPlaceHowFar) != 0) {
    const double how_far = in.real();
    if (!(how_far >= 1 && how_far <= UINT16_MAX)) return in.fail();
    doubt_cm = static_cast<std::uint16_t>(how_far);
  }
  known = (flags & kPlaceKnown) != 0;
  doubted = (flags & kPlaceDoubted) != 0;
  if (!known) return;
  for (double* value :
       {&x_m, &y_m, &yaw_rad, &position_sigma_m, &yaw_sigma_rad, &latitude_deg, &longitude_deg})
    *value = in.real();
}

void put(const OutputsUp& up, ByteWriter& out) {
  out.byte(up.relay_closed ? 1 : 0);
}
void get(OutputsUp& up, ByteReader& in) {
  up.relay_closed = get_flag(in);
}

void put(const ClearanceFound& found, ByteWriter& out) {
  const auto& [t, scene, path, twist, along_m, ahead_m, back_m, left_rad, right_rad, aside_left_m,
               aside_right_m, bare, first, turn, unknown, broken] = found.clearance;
  // Of no time: that permits nothing, and has to stay so.
  out.byte(t == kNever ? 0 : 1);
  out.signed_number(std::max(t, Time{}).time_since_epoch().count());
  out.number(scene);
  out.number(path);
  for (const double value :
       {twist.vx_mps, twist.wz_radps, along_m, ahead_m, back_m, left_rad, right_rad, bare.along_m,
        bare.ahead_m, bare.back_m, bare.left_rad, bare.right_rad})
    out.real(value);
  out.text(first);
  out.text(turn);
  out.text(unknown);
  out.text(broken);
  for (const double value :
       {twist.vy_mps, aside_left_m, aside_right_m, bare.aside_left_m, bare.aside_right_m})
    out.real(value);
}
void get(ClearanceFound& found, ByteReader& in) {
  auto& [t, scene, path, twist, along_m, ahead_m, back_m, left_rad, right_rad, aside_left_m,
         aside_right_m, bare, first, turn, unknown, broken] = found.clearance;
  const bool timed = get_flag(in);
  t = get_time(Time{}, in);
  if (!timed) t = kNever;
  scene = in.number();
  path = in.number();
  for (double* value :
       {&twist.vx_mps, &twist.wz_radps, &along_m, &ahead_m, &back_m, &left_rad, &right_rad,
        &bare.along_m, &bare.ahead_m, &bare.back_m, &bare.left_rad, &bare.right_rad})
    *value = in.real();
  first.assign(in.text());
  turn.assign(in.text());
  unknown.assign(in.text());
  broken.assign(in.text());
  for (double* value :
       {&twist.vy_mps, &aside_left_m, &aside_right_m, &bare.aside_left_m, &bare.aside_right_m})
    *value = in.real();
}

void put(const LearnedRecalled& recalled, ByteWriter& out) {
  out.byte(recalled.learned.receiver);
  out.byte(recalled.learned.imu);
  each_learned(recalled.learned, [&out](const char*, const LearnedValue& value) {
    out.real(value.value);
    out.real(value.sigma);
  });
}
void get(LearnedRecalled& recalled, ByteReader& in) {
  recalled.learned.receiver = in.byte();
  recalled.learned.imu = in.byte();
  each_learned(recalled.learned, [&in](const char*, LearnedValue& value) {
    value.value = in.real();
    value.sigma = in.real();
  });
}

// Bodies of commands: the same once more.

void put(const std::monostate&, ByteWriter&) {}
void get(std::monostate&, ByteReader&) {}
void put(const CancelTask&, ByteWriter&) {}
void get(CancelTask&, ByteReader&) {}
void put(const EngageStop&, ByteWriter&) {}
void get(EngageStop&, ByteReader&) {}
void put(const ResetStop&, ByteWriter&) {}
void get(ResetStop&, ByteReader&) {}
void put(const ProposeOrigin&, ByteWriter&) {}
void get(ProposeOrigin&, ByteReader&) {}
void put(const FindHeading&, ByteWriter&) {}
void get(FindHeading&, ByteReader&) {}
void put(const ArmHold&, ByteWriter&) {}
void get(ArmHold&, ByteReader&) {}
void put(const AcceptPosition&, ByteWriter&) {}
void get(AcceptPosition&, ByteReader&) {}
void put(const ForgetLearned&, ByteWriter&) {}
void get(ForgetLearned&, ByteReader&) {}
void put(const DriveByHand& drive, ByteWriter& out) {
  out.number(drive.hand);
  out.real(drive.twist.vx_mps);
  out.real(drive.twist.wz_radps);
}
void get(DriveByHand& drive, ByteReader& in) {
  drive.hand = in.number();
  drive.twist.vx_mps = in.real();
  drive.twist.wz_radps = in.real();
}
void put(const FollowTwist& follow, ByteWriter& out) {
  out.real(follow.twist.vx_mps);
  out.real(follow.twist.wz_radps);
  out.byte(follow.after_motion ? 1 : 0);
  out.real(follow.twist.vy_mps);
}
void get(FollowTwist& follow, ByteReader& in) {
  follow.twist.vx_mps = in.real();
  follow.twist.wz_radps = in.real();
  follow.after_motion = get_flag(in);
  follow.twist.vy_mps = in.real();
}
void put(const TwistRefused& refused, ByteWriter& out) {
  out.text(refused.reason);
  out.byte(refused.ends ? 1 : 0);
}
void get(TwistRefused& refused, ByteReader& in) {
  refused.reason.assign(in.text());
  refused.ends = get_flag(in);
}
void put(const ReleaseHold& release, ByteWriter& out) {
  out.byte(release.on_slope ? 1 : 0);
}
void get(ReleaseHold& release, ByteReader& in) {
  release.on_slope = get_flag(in);
}

void put(const SetOrigin& set, ByteWriter& out) {
  out.real(set.origin.latitude_deg);
  out.real(set.origin.longitude_deg);
  out.real(set.origin.altitude_m);
}
void get(SetOrigin& set, ByteReader& in) {
  set.origin.latitude_deg = in.real();
  set.origin.longitude_deg = in.real();
  set.origin.altitude_m = in.real();
}

void put(const JointTargets& targets, ByteWriter& out) {
  out.number(targets.joints.size());
  for (const auto& joint : targets.joints) {
    const auto& [axis, velocity_radps, position_rad, effort_Nm, stiffness, damping] = joint;
    out.byte(axis);
    for (const double value : {velocity_radps, position_rad, effort_Nm, stiffness, damping})
      out.real(value);
  }
}
void get(JointTargets& targets, ByteReader& in) {
  const auto count = in.below(targets.joints.capacity() + 1);
  for (std::uint64_t i = 0; i < count && in.good(); ++i) {
    JointTarget joint{static_cast<AxisId>(in.below(kMaxAxes))};
    auto& [axis, velocity_radps, position_rad, effort_Nm, stiffness, damping] = joint;
    for (double* const value : {&velocity_radps, &position_rad, &effort_Nm, &stiffness, &damping})
      *value = in.real();
    (void)targets.joints.push_back(joint);
  }
}

void put(const JointTargetsRefused& refused, ByteWriter& out) {
  out.text(refused.reason);
  out.byte(refused.was_there ? 1 : 0);
}
void get(JointTargetsRefused& refused, ByteReader& in) {
  refused.reason.assign(in.text());
  refused.was_there = get_flag(in);
}

/// Above the target in its number.
constexpr std::uint64_t kOvertaken = std::uint64_t{1} << 32U;

/// The path was recorded before, by the thread that made it.
void put(const StartTask& start, ByteWriter& out) {
  out.number(start.path == nullptr ? 0 : start.path->number);
  out.number(start.target | (start.overtaken ? kOvertaken : 0));
  out.real(start.speed_mps);
}
void get(StartTask& start, const FindPath& find_path, ByteReader& in) {
  const auto number = in.number();
  if (number != 0 && in.good()) {
    start.path = find_path(number);
    if (start.path == nullptr) in.fail();
  }
  const auto target = in.below(2 * kOvertaken);
  start.target = static_cast<std::uint32_t>(target % kOvertaken);
  start.overtaken = target >= kOvertaken;
  start.speed_mps = in.real();
}

void put(const CommandGiven& given, ByteWriter& out) {
  const auto& command = given.command;
  out.byte(static_cast<std::uint8_t>(command.id.source));
  out.number(command.id.number);
  // What nobody received is as old as can be.
  out.signed_number(std::max(command.received, Time{}).time_since_epoch().count());
  out.byte(static_cast<std::uint8_t>(command.body.index()));
  std::visit([&](const auto& body) { put(body, out); }, command.body);
}

/// Calls `use` with an empty alternative of `Variant`, by its number.
template <class Variant, std::size_t I = 0, class Use>
void with_alternative(std::size_t index, Variant& into, const Use& use) {
  if constexpr (I < std::variant_size_v<Variant>) {
    if (index == I) return use(into.template emplace<I>());
    with_alternative<Variant, I + 1>(index, into, use);
  }
}

void get(CommandGiven& given, const FindPath& find_path, ByteReader& in) {
  auto& command = given.command;
  command.id.source =
      static_cast<RequestId::Source>(in.below(static_cast<unsigned>(RequestId::Source::ros2) + 1));
  command.id.number = in.number();
  command.received = get_time(Time{}, in);
  const auto index = in.below(std::variant_size_v<decltype(command.body)>);
  with_alternative(index, command.body, [&](auto& body) {
    if constexpr (std::is_same_v<std::decay_t<decltype(body)>, StartTask>) {
      get(body, find_path, in);
    } else {
      get(body, in);
    }
  });
}

}  // namespace

void write_frame(const CanFrame& frame, ByteWriter& out) {
  put_frame(frame, out);
}

CanFrame read_frame(ByteReader& in) {
  return get_frame(in);
}

void write_input(const Input& input, Time before, ByteWriter& out) {
  out.signed_number((input.time - before).count());
  std::visit([&](const auto& body) { put(body, out); }, input.body);
}

Input read_input(std::uint8_t kind, Time before, const FindPath& find_path, ByteReader& in) {
  Input input;
  input.time = get_time(before, in);
  if (kind >= kInputKinds) in.fail();
  if (!in.good()) return input;
  with_alternative(kind, input.body, [&](auto& body) {
    if constexpr (std::is_same_v<std::decay_t<decltype(body)>, CommandGiven>) {
      get(body, find_path, in);
    } else {
      get(body, in);
    }
  });
  return input;
}

}  // namespace drover::gateway
