// Who may touch a line: it is the control thread's, which lends it to the serial thread. One word
// says so, that neither thread can change between the other's look at it and its answer.
#pragma once

#include <atomic>

namespace drover::runtime {

class LineHold final {
 public:
  // Control thread:
  /// Of a line that nobody holds.
  void lend() { state_.store(State::lent, std::memory_order_release); }
  /// True: nobody holds it, and it may be closed. False: ask again.
  [[nodiscard]] bool take_back() {
    State is = State::lent;
    if (state_.compare_exchange_strong(is, State::nobodys, std::memory_order_acq_rel)) return true;
    if (is == State::held) state_.compare_exchange_strong(is, State::wanted_back);
    return is == State::nobodys;
  }

  // Serial thread:
  /// True: a line was lent, and is held from now on.
  [[nodiscard]] bool begin() {
    State is = State::lent;
    return state_.compare_exchange_strong(is, State::held, std::memory_order_acq_rel);
  }
  /// Lets go of what is wanted back.
  void obey() {
    if (state_.load(std::memory_order_relaxed) == State::wanted_back) let_go();
  }
  void let_go() { state_.store(State::nobodys, std::memory_order_release); }
  bool holds() const {
    const State is = state_.load(std::memory_order_relaxed);
    return is == State::held || is == State::wanted_back;
  }

 private:
  enum class State { nobodys, lent, held, wanted_back };
  std::atomic<State> state_{State::nobodys};
};

}  // namespace drover::runtime
