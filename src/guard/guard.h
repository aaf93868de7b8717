// Watches droverd's heartbeat and plays the stop set when it is late: the cycle, and what droverd
// and people may ask. Each cycle sends first; nothing in it waits for anybody.
#pragma once

#include <sys/types.h>

#include <string_view>
#include <vector>

#include "drover/fixed_text.h"
#include "drover/guard_protocol.h"
#include "guard/keep.h"
#include "guard/notify.h"
#include "guard/speech.h"
#include "guard/stop_port.h"
#include "guard/stop_set.h"
#include "guard/watch.h"

namespace drover::guard {

class Guard final : public StopListener {
 public:
  /// `daemon_uid`: who may hand over a stop set, beside root.
  Guard(int daemon_listener, int stop_listener, uid_t daemon_uid, Speech& speech, Notify& notify);

  /// What the guard before this one left: goes on where that one ended.
  void take_over(std::vector<Kept> kept);
  [[noreturn]] void run();

  void stop(uid_t by) override;
  void reset(uid_t by) override;
  std::string_view state() override;

 private:
  void cycle(Time t);
  void act(Time t);
  void publish();
  void tell(Time t, bool was_holding);
  void pulse();
  void cut_supply();
  bool may_hold();
  std::uint64_t beats() const;

  void accept_daemon();
  void receive();
  void drop_daemon();
  bool obey(const GuardMessage& message, int fd);
  bool begin_set(const GuardMessage& hello, int memory);
  bool take_line(int& line, int fd);
  void end_set();
  void use_next();
  void hand_back();
  void lend(const GuardMessage& message);
  bool let_go(const GuardMessage& message);
  void use_memory(int fd, GuardShared* shared);

  int daemon_listener_;
  StopPort stop_port_;
  uid_t daemon_uid_;
  Speech& speech_;
  Notify& notify_;
  Keep keep_;

  int daemon_ = -1;
  int memory_ = -1;  ///< of `shared_`
  GuardShared* shared_ = nullptr;
  int next_memory_ = -1;
  GuardShared* next_shared_ = nullptr;

  StopSet set_;
  StopSet next_;
  bool next_is_his_ = false;  ///< what `next_` has was handed over by the daemon that is connected
  bool offered_ = false;      ///< `next_` is whole, and lacks axes of `set_`
  bool set_is_his_ = false;   ///< `set_` is that of the daemon that is connected
  std::uint32_t limit_ms_ = 50;
  std::uint32_t next_limit_ms_ = 50;
  Watch watch_;
  bool holding_ = false;

  int pulse_line_ = -1;
  bool pulse_high_ = false;
  int relay_line_ = -1;
  bool supply_cut_ = false;  ///< in this hold
  std::array<char, kGuardNameSize> relay_name_{};

  std::uint64_t died_ = 0;  ///< lines, as told
  std::uint64_t cycles_ = 0;
  bool ready_told_ = false;
  FixedText<400> state_text_;
};

}  // namespace drover::guard
