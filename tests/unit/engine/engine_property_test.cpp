// Random histories: whatever is asked and whatever breaks, in any order, the promises hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "engine_breakdowns.h"
#include "support/seeds.h"

namespace drover::engine {
namespace {

/// Checks every cycle against what a person may rely on, with its own knowledge of what was done.
class Oracle {
 public:
  explicit Oracle(EngineRig& rig) : rig_(rig) {}

  /// After each tick. Returns what is broken, or nothing.
  std::string check() {
    const double fastest_radps = rig_.fastest_command_radps();
    const bool moving = fastest_radps != 0;
    if (!std::isfinite(fastest_radps)) return "a command is not a number";
    if (moving != rig_.out.motion_permitted) return "motion_permitted does not fit the commands";
    for (std::size_t i = 0; i < 4; ++i) {
      const double ramp_radps = std::abs(rig_.out.axes[i].velocity_radps);
      const double wheel_radps = std::abs(rig_.snapshot().axes[i].motion.velocity_radps);
      if (rig_.out.slowing_permitted[i] && ramp_radps > wheel_radps)
        return "a wheel is made faster to hold it";
    }
    if (moving && must_rest(rig_)) return "motion while a stop condition holds";
    const bool task = note_events();
    if (!error_.empty()) return error_;
    // Once a task is over only a ramp may be left, and it only gets slower.
    if (!task) {
      if (fastest_radps > last_radps_ + 1e-6) return "faster without a task";
      idle_ticks_ = moving ? idle_ticks_ + 1 : 0;
      if (idle_ticks_ > 400) return "a stop takes longer than two seconds";
      for (const AxisCommand& axis : rig_.out.axes) {
        if (axis.request == AxisRequest::run && !moving) return "drives are armed without a task";
      }
    } else {
      idle_ticks_ = 0;
    }
    if (task && !accepted_ever_) return "a task without a start";
    if (must_rest(rig_) && rig_.snapshot().why.empty()) return "a stop without a reason";
    last_radps_ = fastest_radps;
    return {};
  }
  /// At the end, when all is cancelled.
  std::string check_balance(std::uint64_t tasks, std::uint64_t commands) const {
    if (released_ != tasks) return "paths and returns do not balance";
    if (answers_ != commands) return "commands and answers do not balance";
    if (open_) return "a task did not end";
    return {};
  }

 private:
  /// Whether a task is on.
  bool note_events() {
    for (; seen_ < rig_.log.size(); ++seen_) {
      const auto& body = rig_.log[seen_].body;
      if (const auto* a = std::get_if<CommandAccepted>(&body)) {
        ++answers_;
        if (starts.count(a->id.number) != 0) {
          if (open_) error_ = "a second task was accepted";
          open_ = accepted_ever_ = true;
          started_ = false;
        }
      } else if (std::holds_alternative<CommandRefused>(body) ||
                 std::holds_alternative<OriginProposed>(body)) {
        ++answers_;
      } else if (std::holds_alternative<NavigationStarted>(body)) {
        if (!open_ || started_) error_ = "started twice or without a task";
        started_ = true;
      } else if (std::holds_alternative<NavigationNotStarted>(body)) {
        if (!open_ || started_) error_ = "not started after started";
        open_ = false;
      } else if (std::holds_alternative<TaskEnded>(body)) {
        if (!open_ || !started_) error_ = "ended without having started";
        open_ = false;
      } else if (std::holds_alternative<PathReleased>(body)) {
        ++released_;
      }
    }
    return open_;
  }

 public:
  std::map<std::uint64_t, bool> starts;  ///< request numbers of StartTask

 private:
  EngineRig& rig_;
  std::size_t seen_ = 0;
  std::string error_;
  bool open_ = false;
  bool started_ = false;
  bool accepted_ever_ = false;
  std::uint64_t answers_ = 0;
  std::uint64_t released_ = 0;
  double last_radps_ = 0;
  int idle_ticks_ = 0;
};

class History {
 public:
  explicit History(std::uint64_t seed) : random_(seed), rig_(rig_config()), oracle_(rig_) {}

  std::string run(int ticks) {
    rig_.tick();
    ask(SetOrigin{kRigOrigin});
    constexpr int kSettling = 60;  // until there is a position
    for (int i = 0; i < kSettling; ++i) {
      rig_.tick();
      if (const std::string broken = oracle_.check(); !broken.empty()) return broken;
    }
    for (int i = 0; i < ticks; ++i) {
      if (one_in_(12)) disturb();
      if (one_in_(40)) mend_all(rig_);
      if (one_in_(15)) command();
      rig_.tick();
      if (const std::string broken = oracle_.check(); !broken.empty()) return broken;
      moved_ = moved_ || rig_.out.motion_permitted;
    }
    ask(CancelTask{});
    rig_.tick();
    if (const std::string broken = oracle_.check(); !broken.empty()) return broken;
    return oracle_.check_balance(oracle_.starts.size(), rig_.asked);
  }
  bool moved() const { return moved_; }

 private:
  template <class Body>
  void ask(const Body& body) {
    if constexpr (std::is_same_v<Body, StartTask>) oracle_.starts[rig_.asked + 1] = true;
    rig_.command(body);
  }
  void command() {
    switch (random_() % 8) {
      case 0: ask(CancelTask{}); break;
      case 1: ask(ResetStop{}); break;
      case 2: ask(ProposeOrigin{}); break;
      case 3: ask(StartTask{&path_, 99, 0.5}); break;
      case 4: ask(StartTask{&path_, 20, -1}); break;
      default: ask(StartTask{&path_, 20, 0.8}); break;
    }
  }
  void disturb() {
    const auto which = static_cast<unsigned>(random_() % (kBreakdowns + 6));
    if (which < kBreakdowns) return break_or_mend(rig_, which, random_);
    switch (which - kBreakdowns) {
      case 0: rig_.lines[2] = one_in_(2); break;
      case 1: rig_.lines[3] = one_in_(2); break;
      case 2: rig_.drives[random_() % 4].refuses = one_in_(2); break;
      case 3: rig_.receiver_silent = one_in_(2); break;
      case 4: rig_.jump_m = one_in_(4) ? 5 : 0; break;
      default: rig_.quality = one_in_(2) ? FixQuality::rtk_fixed : FixQuality::single; break;
    }
  }

  std::mt19937_64 random_;
  OneIn one_in_{random_};
  EngineRig rig_;
  Oracle oracle_;
  Path path_ = straight_path(10);
  bool moved_ = false;
};

// The claim is the plain build's to prove. A sanitizer, ten to twenty times slower, looks for
// mistakes of memory, and a tenth of the histories runs through every line that all of them do.
constexpr std::uint64_t kHistories = test::kSanitized ? 1000 : 10000;
constexpr std::uint64_t kLongHistories = test::kSanitized ? 10 : 100;

TEST(AnyHistory, NeverMovesWhileAStopConditionHoldsNorWithoutAnAcceptedStart) {
  std::uint64_t moved = 0;
  for (std::uint64_t seed = 1; seed <= kHistories; ++seed) {
    History history(seed);
    const std::string broken = history.run(150);
    ASSERT_EQ(broken, "") << "seed " << seed;
    moved += history.moved() ? 1 : 0;
  }
  // Histories in which nothing ever moves would prove nothing.
  EXPECT_GT(moved, kHistories / 10);
  std::printf("%llu of %llu histories had motion\n", static_cast<unsigned long long>(moved),
              static_cast<unsigned long long>(kHistories));
}
TEST(AnyHistory, HoldsItsPromisesOverLongerHistoriesToo) {
  for (std::uint64_t seed = 1; seed <= kLongHistories; ++seed) {
    History history(1000000 + seed);
    ASSERT_EQ(history.run(6000), "") << "seed " << seed;
  }
}
TEST(AnyHistory, NeverMovesWithoutAStartWhateverElseIsAsked) {
  EngineRig rig;
  rig.settle();
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    if (random() % 20 == 0) rig.command(CancelTask{});
    if (random() % 20 == 0) rig.command(ResetStop{});
    if (random() % 20 == 0) rig.command(ProposeOrigin{});
    if (random() % 500 == 0) rig.command(SetOrigin{kRigOrigin});
    if (random() % 100 == 0) rig.lines[random() % kLineCount] = random() % 2 == 0;
    rig.tick();
    ASSERT_EQ(rig.fastest_command_radps(), 0);
    ASSERT_EQ(rig.out.axes[0].request, AxisRequest::rest);
    rig.log.clear();
  }
}

}  // namespace
}  // namespace drover::engine
