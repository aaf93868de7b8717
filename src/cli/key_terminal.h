// The terminal at which a person holds a key.
#pragma once

#include <signal.h>
#include <termios.h>

#include "cli/terminal_watch.h"
#include "drover/time.h"
#include "link/unique_fd.h"

namespace drover::cli {

/// Keys as they come, without an echo, until it is gone: then the terminal is as it was. Who ends
/// the program (SIGTERM, SIGHUP, SIGINT) meanwhile is heard as a key that ends it.
class KeyTerminal final {
 public:
  KeyTerminal();
  ~KeyTerminal();
  KeyTerminal(const KeyTerminal&) = delete;
  KeyTerminal& operator=(const KeyTerminal&) = delete;

  struct Keys {
    Time space = kNever;  ///< when the key came, at the earliest; never: it did not
    bool quit = false;    ///< q, ^C, ^D, a signal, or the terminal is gone
  };
  /// Waits for so long at most.
  Keys read(int wait_ms);
  bool is_silent() const;
  bool answers() const { return watch_.answers(); }
  bool is_late() const;
  double delay_s() const;

 private:
  termios before_{};
  sigset_t blocked_before_{};
  link::UniqueFd signals_;
  Time looked_ = kNever;
  TerminalWatch watch_;
};

}  // namespace drover::cli
