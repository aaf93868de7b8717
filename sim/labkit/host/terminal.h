// Puts the caller's terminal into raw mode for as long as the object lives.
#pragma once

#include <termios.h>

#include "fd.h"

namespace drover::lab {

class RawTerminal final {
 public:
  RawTerminal() {
    if (::tcgetattr(0, &before_) != 0) fail("standard input is not a terminal");
    termios raw = before_;
    ::cfmakeraw(&raw);
    ::tcsetattr(0, TCSANOW, &raw);
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  ~RawTerminal() { ::tcsetattr(0, TCSADRAIN, &before_); }

 private:
  termios before_{};
};

}  // namespace drover::lab
