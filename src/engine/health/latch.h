// What stopped the robot and stays until somebody acts, and who that may be.
#pragma once

#include "drover/command.h"
#include "drover/remembered.h"
#include "engine/health/health.h"

namespace drover::engine {

enum class Latched : std::uint8_t {
  task_failed,     ///< its task ended in an error
  stream_stopped,  ///< its joint commands were; or people stopped it, whoever drove
  asked,           ///< an operator's emergency stop
  ran_away,        ///< a wheel did not obey its drive
  did_not_stop,    ///< it moved when it should rest
};

/// Who ends it, and so who waits until then.
enum class ResetBy : std::uint8_t {
  any_start,  ///< whatever begins next: nothing waits, it is told
  person,     ///< who starts a task, looks for the heading, cancels or resets: joint commands wait
  reset,      ///< nothing begins before it
  at_robot,   ///< the same, and not over the network
};

struct LatchRow {
  Latched what{};
  ResetBy by{};
  bool cuts_power = false;
};

inline constexpr std::array<LatchRow, 5> kLatches{{
    {Latched::task_failed, ResetBy::any_start},
    {Latched::stream_stopped, ResetBy::person},
    {Latched::asked, ResetBy::reset},
    {Latched::ran_away, ResetBy::reset},
    {Latched::did_not_stop, ResetBy::at_robot, true},
}};

/// What somebody did, and thereby ended.
enum class Act : std::uint8_t {
  begin,   ///< something has begun: how the last task ended is no news any more
  take,    ///< a person has taken the drives: joint commands need not wait for one
  cancel,  ///< both
  reset,   ///< everything
};

/// A reset, and how things are when it comes.
struct ResetAsked {
  RequestId::Source by = RequestId::Source::internal;
  Reason runs_away = {};  ///< which wheel does now; empty: none
  bool moves = false;     ///< anything says that the robot does
  bool turns = false;     ///< its wheels do, by their own word
  bool task_active = false;
  bool at_rest = true;  ///< nothing is commanded
  const HealthReport& health;
};

/// All that is latched in the engine. Set, reset, recalled and kept by one function each; whoever
/// has to know what stopped the robot reads it here.
class Latch final {
 public:
  void set(Latched what, const Reason& why);
  void reset(Act act);
  /// Why a reset cannot be had; empty: it can.
  Reason refuses(const ResetAsked& asked) const;

  /// Before the first cycle: what the program before this one left.
  void recall(const Remembered& remembered);
  void remember(Remembered& out) const;

  /// What a person has to know of first; empty: nothing is latched.
  const Reason& why() const;
  /// Nothing moves until it is reset.
  const Reason& stop() const { return stop_; }
  /// How the last task ended.
  const Reason& task() const { return task_; }
  /// "reset the stop first: ..."; empty: it may begin.
  Reason hinders_all() const;
  Reason hinders_joints() const;
  bool ran_away() const { return ran_away_; }
  bool power_cut() const { return power_cut_; }

 private:
  Reason stop_;    ///< until a reset
  Reason joints_;  ///< until a person acts
  Reason task_;    ///< until something begins
  bool at_robot_ = false;
  bool power_cut_ = false;
  bool ran_away_ = false;
};

}  // namespace drover::engine
