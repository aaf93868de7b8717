// The line to droverd: found again for ever, with a growing pause.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "drover/time.h"
#include "link/unique_fd.h"
#include "runtime/back_off.h"

namespace drover::ros2 {

class DaemonLink final {
 public:
  explicit DaemonLink(std::string path) : path_(std::move(path)) {}

  /// Once a beat: connects when there is none, and it is time to try.
  void keep(Time now);
  bool connected() const { return static_cast<bool>(fd_); }
  /// Readable when lines came; -1: none.
  int fd() const { return fd_.get(); }
  /// Each whole line that has come; of a way that is lost what came before.
  void hear(const std::function<void(std::string_view)>& on_line);
  /// What does not leave at once never leaves: droverd does not read, the link is made anew. False:
  /// it has not left.
  [[nodiscard]] bool send(const std::string& line);
  /// Somebody needs it now: the next keep() does not wait.
  void hurry() { retry_.try_now(); }
  /// Why there is none; empty: there is.
  const std::string& problem() const { return problem_; }

 private:
  /// False: nothing came, or the way is lost.
  bool read();
  void lose(const std::string& why);

  std::string path_;
  link::UniqueFd fd_;
  std::string in_;
  std::string problem_ = "not connected yet";
  runtime::BackOff retry_{std::chrono::milliseconds(200), std::chrono::seconds(5)};
};

}  // namespace drover::ros2
