// Opens links and opens them again for ever, with a growing pause, in a thread of its own: opening
// and closing may allocate or block, which the control thread must not. Keeps the guard supplied
// too.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/fixed_text.h"
#include "drover/spsc_ring.h"
#include "gateway/gateway.h"
#include "link/can_open.h"
#include "link/lines.h"
#include "link/outputs.h"
#include "link/serial_link.h"
#include "runtime/back_off.h"
#include "runtime/guard_client.h"
#include "runtime/wake.h"

namespace drover::runtime {

using gateway::Gateway;
using gateway::kMaxBuses;
using gateway::LinkId;
using gateway::StreamOutput;
using gateway::Wiring;

/// Slots: the gateway's links by their numbers, and behind them the outputs' chip. What is polled
/// is opened by the thread that polls it, and has no use for its slot.
inline constexpr std::size_t kOutputsSlot = gateway::kMaxLinks;
inline constexpr std::size_t kLinkSlots = kOutputsSlot + 1;

/// A link on its way between the keeper and the control thread; which pointer is set follows the
/// slot.
struct LinkHandover {
  std::size_t slot = 0;
  std::unique_ptr<link::CanLink> can;
  std::unique_ptr<link::SerialLink> serial;
  std::unique_ptr<link::LineLink> lines;
  std::unique_ptr<link::OutputLink> outputs;
  /// keeper → control: why there is no link; control → keeper: why it was given back
  Reason problem;
  int reopen_baud = 0;  ///< control → keeper, streams: open it again at this speed; 0: as before
  bool opened() const { return can || serial || lines || outputs; }
};

/// A device that comes back is there within a second: the pause never grows beyond half of it. It
/// begins short, since an arm falls when its motors' time-outs, of 100 ms, run out.
inline constexpr BackOff kLinkPause{std::chrono::milliseconds(5), std::chrono::milliseconds(500)};

class LinkKeeper final {
 public:
  LinkKeeper(const config::DroverConfig& config, const Wiring& wiring, const GuardMemory& memory,
             std::vector<gateway::LinkDuty> duties);

  // Control thread:
  bool take(LinkHandover& arrived) { return arrivals_.pop(arrived); }
  /// False when the queue is full: keep it and try again next cycle.
  bool give_back(LinkHandover& lost);
  /// False: the guard lacks a descriptor for a bus that is open, and cannot stop its drives. Where
  /// it lacks it from the beginning, the control thread does not get that bus.
  bool guard_equipped() const { return guard_equipped_.load(std::memory_order_relaxed); }
  void request_hand_back() {
    hand_back_wanted_.store(true, std::memory_order_relaxed);
    wake_.notify();
  }

  // Keeper thread:
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts at least once a second while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

 private:
  struct Slot {
    bool used = false;
    bool open = false;
    BackOff retry = kLinkPause;
    std::string problem;
    int baud = 0;               ///< of a stream
    bool guard_reaches = true;  ///< the guard has a way there, as it said last
    std::string guard_lacks;    ///< why it could not have the way there of this opening
    /// Of a stream on which something moves: a duplicate of the open file, for the guard.
    link::UniqueFd tty;
  };
  const config::LinkConfig& settings_of(std::size_t slot) const;
  bool is_bus(std::size_t slot) const {
    return slot < wiring_.links.size() && wiring_.links[slot].wire == Wire::can;
  }
  /// Something on it moves: the guard has its own way to it, to stop it.
  bool is_guarded(std::size_t slot) const {
    return slot < wiring_.links.size() && !duties_[slot].stops.empty();
  }
  bool is_guarded_tty(std::size_t slot) const {
    return is_guarded(slot) && wiring_.links[slot].wire == Wire::bytes;
  }
  void take_back_lost();
  void open_missing(Time now);
  void try_open(std::size_t slot, Time now);
  void hand_on(Time now);
  LinkHandover open(std::size_t slot, std::string& problem);
  link::Opened<link::OutputLink> open_outputs();
  link::Opened<link::SerialLink> open_stream(std::size_t slot);
  GuardedLink guarded_link(std::size_t slot);
  void open_for_guard(std::size_t slot, GuardedLink& link);
  link::UniqueFd borrow(const std::string& name);
  void ask_guard();
  /// The first of the links that the control thread has; empty: the guard lacks nothing of them.
  std::string lacking() const;
  bool is_new(std::size_t slot) const;
  bool refuses_new() const;
  std::string watched() const;
  void tell(std::size_t slot);
  std::vector<std::string> line_names(std::size_t slot) const;
  link::CanSettings can_settings(std::size_t bus) const;
  void failed(std::size_t slot, const std::string& problem, Time now);
  void supply_guard(Time now);
  void supply_watchdog(Time now);
  void supply_relay();
  void forget_relay();
  void forget_tty(std::size_t slot);
  Duration until_next_try(Time now) const;

  const config::DroverConfig& config_;
  const Wiring& wiring_;
  std::vector<gateway::LinkDuty> duties_;  ///< by the gateway's links
  const GuardShared& guard_signs_;
  std::array<Slot, kLinkSlots> slots_{};
  std::vector<LinkHandover> opened_;  ///< not with the control thread yet
  SpscRing<LinkHandover, 16> arrivals_;
  SpscRing<LinkHandover, 16> losses_;
  Wake wake_;
  std::atomic<std::uint64_t> turns_{0};
  std::atomic<bool> hand_back_wanted_{false};
  std::atomic<bool> guard_equipped_{true};
  GuardClient guard_;
  Slot guard_slot_;
  bool guard_set_changed_ = true;
  Slot watchdog_;               ///< of the line that the guard pulses
  Time watchdog_try_ = kNever;  ///< not before
  std::string relay_name_;      ///< empty: there is none
  link::UniqueFd relay_;        ///< a duplicate of the enable relay's line handle, for the guard
  bool relay_given_ = false;
};

}  // namespace drover::runtime
