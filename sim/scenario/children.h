// The programs that a scenario runs: started, signalled, and ended with the player.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "link/unique_fd.h"
#include "sim/scenario/held_thread.h"

namespace drover::sim {

struct Program {
  std::string name;
  std::vector<std::string> command;  ///< the first is a path
};

class Children {
 public:
  /// Standard output and error of each go to LOG_FOLDER/NAME.log, appended.
  explicit Children(std::string log_folder) : log_folder_(std::move(log_folder)) {}
  ~Children() { kill_all(); }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Returns what went wrong, empty when nothing. A program of this name must not run.
  std::string start(const Program& program);
  /// False: it does not run.
  bool signal(const std::string& name, int number);
  /// One of its threads stands still while the returned object lives; null: it cannot be held.
  std::unique_ptr<HeldThread> hold(const std::string& name, const std::string& thread) const;
  bool runs(const std::string& name) const { return children_.contains(name); }
  bool none() const { return children_.empty(); }

  /// Descriptors that become readable when a child ends.
  std::vector<int> descriptors() const;
  struct Ended {
    std::string name;
    int status = 0;  ///< of waitpid
  };
  /// Those that have ended since, in the order of their names.
  std::vector<Ended> reap();
  void kill_all();

 private:
  struct Child {
    pid_t pid = -1;
    link::UniqueFd pidfd;
  };
  std::string log_folder_;
  std::map<std::string, Child> children_;
};

/// Finds NAME in FOLDER itself or where the build leaves it; "" when it is in none.
std::string find_program(const std::string& folder, const std::string& name);

}  // namespace drover::sim
