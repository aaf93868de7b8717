// Random histories of all commands, restarts among them: nothing speeds up unless somebody who may
// asked for it, a stop stands until it is reset, and drives that were released are left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "engine/own/twist_stream.h"
#include "engine_breakdowns.h"
#include "support/seeds.h"

namespace drover::engine {
namespace {

constexpr double kLongestHeadingSearch_s = 60;

/// What a person knows who saw each command and each answer, and nothing else.
class Witness {
 public:
  explicit Witness(EngineRig& rig) : rig_(rig) {}

  void asks(const decltype(Command::body)& body) {
    const std::uint64_t id = rig_.asked + 1;
    if (std::holds_alternative<StartTask>(body)) starts_.insert(id);
    if (std::holds_alternative<FindHeading>(body)) searches_.insert(id);
    if (std::holds_alternative<ResetStop>(body)) resets_.insert(id);
    if (std::holds_alternative<ReleaseHold>(body)) releases_.insert(id);
    if (std::holds_alternative<ArmHold>(body)) arms_.insert(id);
    if (std::holds_alternative<EngageStop>(body)) {
      unanswered_ = unanswered_ || !stopped_;
      stopped_ = true;
    }
    const bool ends = std::holds_alternative<CancelTask>(body);
    if (stopped_ || ends) {
      search_until_ = kNever;
      streams_ = twists_ = false;
    }
    if (const auto* follow = std::get_if<FollowTwist>(&body)) {
      if (!stopped_ && is_zero(follow->twist)) twists_ = true;
      if (twists_) last_twist_ = rig_.now;
    }
    if (const auto* targets = std::get_if<JointTargets>(&body)) {
      const auto zero = [](const JointTarget& t) { return t.velocity_radps == 0; };
      const auto& joints = targets->joints;
      // A stream that was ended begins with rest, or not at all.
      if (!stopped_ && std::all_of(joints.begin(), joints.end(), zero)) streams_ = true;
      if (streams_) last_target_ = rig_.now;
    }
    if (const auto* hand = std::get_if<DriveByHand>(&body)) {
      if (is_zero(hand->twist))
        hands_[hand->hand].since = kNever;
      else
        keys_[id] = {*hand, rig_.now};
    }
    if (stopped_ || ends)
      for (auto& [whose, hand] : hands_) hand.spoil();
  }

  /// After each tick. Returns what is broken, or nothing.
  std::string check() {
    read_answers();
    unanswered_ = false;
    const double fastest_radps = rig_.fastest_command_radps();
    const bool faster = fastest_radps > last_radps_ + 1e-6;
    last_radps_ = fastest_radps;
    if (!std::isfinite(fastest_radps)) return "a command is not a number";
    if ((fastest_radps != 0) != rig_.out.motion_permitted)
      return "motion_permitted does not fit the commands";
    if (fastest_radps != 0 && must_rest(rig_)) return "motion while a stop condition holds";
    if (released_ && !left_alone()) return "drives that were released are not left alone";
    if (faster && stopped_) return "faster after a stop that nobody reset";
    if (!faster || task_ || searching() || streaming()) return {};
    if (!held()) return "faster, and nobody asked for it";
    driven_by_.insert(driver_);
    if (std::signbit(along_radps()) != std::signbit(hands_[driver_].vx_mps))
      return "faster, but the other way than it was asked for";
    driven_ways_.insert(std::signbit(along_radps()));
    return {};
  }
  const std::set<std::uint64_t>& driven_by() const { return driven_by_; }
  const std::set<bool>& driven_ways() const { return driven_ways_; }
  /// A restart of the program ends all that drove.
  void restarts() {
    // A stop over which the program died in the very cycle was never answered: who asked for it
    // knows that, and asks again.
    if (unanswered_) stopped_ = unanswered_ = false;
    task_ = streams_ = twists_ = false;
    search_until_ = kNever;
    hands_.clear();
    last_radps_ = 0;
    seen_ = rig_.log.size();
  }

 private:
  bool searching() const { return rig_.now < search_until_; }
  bool streaming() const {
    if (twists_ && rig_.now - last_twist_ < TwistStream::kTimeout + kRigTick) return true;
    return streams_ &&
           rig_.now - last_target_ < from_s(rig_.config.health.joint_command_timeout_s) + kRigTick;
  }
  struct Key {
    DriveByHand asked;
    Time at = kNever;
  };
  /// One who has a key, by the answers that he got.
  struct Hand {
    Time since = kNever;   ///< of a row that was accepted, without a word of rest in it
    Time last = kNever;    ///< a key, also one that was refused
    bool spoiled = false;  ///< a row that was ended moves nothing any more
    double vx_mps = 0;

    void spoil() {
      spoiled = true;
      since = kNever;
    }
    void press(const Key& key, bool accepted) {
      if (last == kNever || key.at - last > kKeyHeld) {
        spoiled = false;
        since = kNever;
      }
      last = key.at;
      vx_mps = key.asked.twist.vx_mps;
      if (!accepted) return spoil();
      if (!spoiled && since == kNever) since = key.at;
    }
  };
  bool held() {
    const Hand& hand = hands_[driver_];
    return hand.since != kNever && rig_.now - hand.since >= kKeyHeld &&
           rig_.now - hand.last <= kKeyHeld + kRigTick;
  }
  void answer_key(std::uint64_t id, bool accepted) {
    const auto key = keys_.find(id);
    if (key == keys_.end()) return;
    const auto whose = key->second.asked.hand;
    if (accepted && std::exchange(driver_, whose) != whose) hands_[whose].since = kNever;
    hands_[whose].press(key->second, accepted);
    keys_.erase(key);
  }
  double along_radps() const {
    double sum_radps = 0;
    for (const AxisCommand& axis : rig_.out.axes) sum_radps += axis.velocity_radps;
    return sum_radps;
  }
  bool left_alone() const {
    const auto& slowing = rig_.out.slowing_permitted;
    const auto idle = [](const AxisCommand& axis) { return axis.request == AxisRequest::idle; };
    return std::find(slowing.begin(), slowing.end(), true) == slowing.end() &&
           std::all_of(rig_.out.axes.begin(), rig_.out.axes.begin() + 4, idle);
  }
  void read_answers() {
    for (; seen_ < rig_.log.size(); ++seen_) {
      const auto& body = rig_.log[seen_].body;
      if (std::holds_alternative<TaskEnded>(body) ||
          std::holds_alternative<NavigationNotStarted>(body))
        task_ = false;
      if (const auto* refused = std::get_if<CommandRefused>(&body))
        answer_key(refused->id.number, false);
      const auto* accepted = std::get_if<CommandAccepted>(&body);
      if (accepted == nullptr) continue;
      const auto id = accepted->id.number;
      answer_key(id, true);
      task_ = task_ || starts_.count(id) != 0;
      if (searches_.count(id) != 0) search_until_ = rig_.now + from_s(kLongestHeadingSearch_s);
      if (resets_.count(id) != 0) stopped_ = false;
      if (releases_.count(id) != 0) released_ = true;
      if (arms_.count(id) != 0) released_ = false;
    }
  }

  EngineRig& rig_;
  std::size_t seen_ = 0;
  std::set<std::uint64_t> starts_, searches_, resets_, releases_, arms_;
  bool task_ = false;
  bool stopped_ = false;
  bool unanswered_ = false;  ///< that stop, before its cycle was over
  bool released_ = false;
  bool streams_ = false;
  bool twists_ = false;
  Time last_target_ = kNever;
  Time last_twist_ = kNever;
  Time search_until_ = kNever;
  std::map<std::uint64_t, Key> keys_;  ///< by request; not answered yet
  std::map<std::uint64_t, Hand> hands_;
  std::uint64_t driver_ = 0;  ///< whose key was accepted last
  std::set<std::uint64_t> driven_by_;
  std::set<bool> driven_ways_;
  double last_radps_ = 0;
};

class AnyCommands {
 public:
  explicit AnyCommands(std::uint64_t seed) : random_(seed), rig_(rig_config()), witness_(rig_) {
    rig_.imu = one_in_(2);
    rig_.no_heading = one_in_(3);
  }

  std::string run(int ticks) {
    rig_.tick();
    ask(SetOrigin{kRigOrigin});
    for (int i = 0; i < 200 + ticks; ++i) {
      if (i > 200 && one_in_(20)) command();
      if (i > 200 && one_in_(30)) disturb();
      if (one_in_(60)) mend_all(rig_);
      if (one_in_(400)) restart();
      if (one_in_(4)) stream();
      rig_.tick();
      if (auto broken = witness_.check(); !broken.empty()) return broken;
      moved_ = moved_ || rig_.out.motion_permitted;
    }
    return {};
  }
  bool moved() const { return moved_; }
  const Witness& witness() const { return witness_; }

 private:
  void ask(const decltype(Command::body)& body) {
    witness_.asks(body);
    rig_.command(body);
  }
  void command() {
    static_assert(std::variant_size_v<decltype(Command::body)> == 17,
                  "a new command has its place here, and in what the witness knows of it");
    switch (random_() % 22) {
      case 0: return ask(CancelTask{});
      case 1: return ask(EngageStop{});
      case 2:
      case 3: return ask(ResetStop{});
      case 4: return ask(ProposeOrigin{});
      case 5: return ask(SetOrigin{kRigOrigin});
      case 6: return ask(JointTargetsRefused{"not understood"});
      case 7: return ask(FindHeading{});
      case 8: return ask(ReleaseHold{one_in_(2)});
      case 9:
      case 10: return ask(ArmHold{});
      case 11: streams_ = !streams_; return;
      case 12: streamed_radps_ = one_in_(2) ? 0 : 2; return;
      case 13: return ask(AcceptPosition{});
      case 14: return ask(ForgetLearned{});
      case 15:
      case 16: {
        const auto which = one_in_(2) ? 0U : 1U;
        held_[which] = !held_[which];
        ahead_[which] = one_in_(2);
        return;
      }
      case 17: twists_ = !twists_; return;
      case 18: twist_ = one_in_(2) ? Twist{} : Twist{one_in_(2) ? 0.5 : -0.5, 0.2}; return;
      default: return ask(StartTask{&path_, 20, 0.8});
    }
  }
  void stream() {
    for (unsigned i = 0; i < held_.size(); ++i) {
      if (held_[i] && !one_in_(100))
        ask(DriveByHand{i + 1, {ahead_[i] ? 0.5 : -0.5, 0.2}});
      else if (held_[i] || one_in_(100))
        ask(DriveByHand{i + 1, {}});
    }
    if (one_in_(100)) ask(TwistRefused{"linear.y is 1"});
    if (twists_) ask(FollowTwist{twist_});
    if (!streams_) return;
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, streamed_radps_});
    ask(targets);
  }
  void disturb() {
    const auto which = static_cast<unsigned>(random_() % (kBreakdowns + 2));
    if (which < kBreakdowns) return break_or_mend(rig_, which, random_);
    if (which == kBreakdowns) {
      rig_.gravity_mps2 = one_in_(2) ? Vector3{4, 0, 8.96} : Vector3{0, 0, 9.81};
    } else {
      rig_.no_heading = one_in_(2);
    }
  }
  /// The program died and is back; what it remembered is all that it knows.
  void restart() {
    const Remembered remembered = rig_.out.remembered;
    rig_.engine = std::make_unique<Engine>(rig_.config);
    rig_.engine->recall(remembered, rig_.now);
    rig_.out = {};
    witness_.restarts();
    ask(SetOrigin{kRigOrigin});
  }

  std::mt19937_64 random_;
  OneIn one_in_{random_};
  EngineRig rig_;
  Witness witness_;
  Path path_ = straight_path(10);
  bool streams_ = false;
  double streamed_radps_ = 0;
  bool twists_ = false;
  Twist twist_;
  std::array<bool, 2> held_{};
  std::array<bool, 2> ahead_{};
  bool moved_ = false;
};

constexpr std::uint64_t kHistories = test::kSanitized ? 50 : 500;

TEST(AnyCommands, MoveNothingThatWasStoppedReleasedOrNotAskedFor) {
  std::uint64_t moved = 0;
  std::set<std::uint64_t> hands;
  std::set<bool> ways;
  for (std::uint64_t seed = 1; seed <= kHistories; ++seed) {
    AnyCommands history(seed);
    ASSERT_EQ(history.run(1000), "") << "seed " << seed;
    moved += history.moved() ? 1 : 0;
    hands.insert(history.witness().driven_by().begin(), history.witness().driven_by().end());
    ways.insert(history.witness().driven_ways().begin(), history.witness().driven_ways().end());
  }
  EXPECT_EQ(hands.size(), 2U) << "both drove";
  EXPECT_EQ(ways.size(), 2U) << "ahead and back";
  EXPECT_GT(moved, kHistories / 4) << "histories without motion prove nothing";
  std::printf("%llu of %llu histories had motion\n", static_cast<unsigned long long>(moved),
              static_cast<unsigned long long>(kHistories));
}

}  // namespace
}  // namespace drover::engine
