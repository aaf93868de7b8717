// What outlives the guard's own death, in the service manager's store of descriptors: the stop set
// (links, and its words in a sealed memory file), the memory with droverd's heartbeat, and whether
// it held. Never the enable relay's line: it has to fall when both programs are gone.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "drover/guard_protocol.h"
#include "guard/notify.h"
#include "guard/stop_set.h"

namespace drover::guard {

/// Written as it changes; zeros when there is nothing to remember. Only the guard has it: droverd,
/// however broken, cannot write here.
struct KeptState {
  std::atomic<std::uint32_t> version;
  std::atomic<std::uint32_t> holding;
  std::atomic<std::uint32_t> latched;
  std::atomic<std::uint32_t> latched_by_uid;
  std::atomic<GuardMayHold> may_hold;
};

class Keep final {
 public:
  explicit Keep(Notify& notify) : notify_(notify) {}

  /// What a guard before this one left. `limit_ms` and `memory` (a descriptor, -1: none) belong to
  /// `set`. False when there was no whole set, or an empty one; then all three are as they were.
  bool restore(std::vector<Kept> kept, StopSet& set, std::uint32_t& limit_ms, int& memory);
  /// Never nullptr after restore(); without memory for it one that dies with the process.
  KeptState& state() { return *state_; }

  /// From now on this is what the next guard shall find; step() brings it there.
  void keep(const StopSet& set, std::uint32_t limit_ms);
  /// Once a cycle, with what keep() was given. A few datagrams each time: their queue is short, and
  /// who reads it may be slow. At each moment there is a whole set, old, new or a mixture: a link's
  /// old descriptor does as well. Only a link that was opened anew is without its way between two
  /// datagrams. `memory` stays the caller's.
  void step(const StopSet& set, int memory);

 private:
  bool map_state(int fd);
  bool take_step(const std::string& step, const StopSet& set, int memory);
  bool store_anew(const std::string& name, int fd);

  Notify& notify_;
  KeptState own_{};
  KeptState* state_ = &own_;
  int state_fd_ = -1;
  bool state_stored_ = false;  ///< it stays the same file
  int recipe_ = -1;
  std::uint32_t edition_ = 0;        ///< of the recipe
  std::size_t whole_ = 1;            ///< which of the recipe's two names has one that is kept
  std::size_t coming_ = 0;           ///< and which the next one gets
  std::vector<std::string> stored_;  ///< names that are kept now, or may be
  std::vector<std::string> steps_;   ///< names to be stored anew, then "-name": to be forgotten
  std::size_t next_step_ = 0;
};

}  // namespace drover::guard
