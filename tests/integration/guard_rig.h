// The real drover-guard as a process, with socket pairs and pseudo-terminals for its links, and
// droverd's own client for what it is told.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "link/unique_fd.h"
#include "runtime/guard_client.h"

namespace drover::test {

struct KeptDescriptor {
  std::string name;
  link::UniqueFd fd;
};

/// Stands in for the service manager: hears notifications and keeps descriptors, with its rules:
/// a file that is kept already is not kept again, one that hung up goes unless FDPOLL=0 came with
/// it.
class ServiceManager {
 public:
  explicit ServiceManager(std::string path);
  const std::string& path() const { return path_; }
  /// Takes what has come; true when `words` was among it now or before.
  bool heard(const std::string& words);
  /// What it keeps now.
  std::vector<KeptDescriptor>& kept();
  bool keeps(const std::string& name);
  /// From now on nobody reads, and there is room for no more.
  void stop_reading();

 private:
  void take();
  void store(const std::string& words, link::UniqueFd fd);

  std::string path_;
  link::UniqueFd fd_;
  std::string words_;
  std::vector<KeptDescriptor> kept_;
};

class GuardRig : public testing::Test {
 protected:
  GuardRig();
  ~GuardRig() override;

  struct Start {
    int standard_error = -1;            ///< -1: a file
    ServiceManager* manager = nullptr;  ///< it also gives what it keeps
    std::string user{};                 ///< --user
    bool wait = true;                   ///< until it listens
  };
  void start(const Start& how);
  void start() { start(Start{}); }
  void kill();
  pid_t pid() const { return pid_; }
  /// Exit status, or -1 while it runs at the deadline.
  int wait_for_end();

  /// A CAN link with axes of these addresses; the drives' end is what `drives` reads.
  runtime::GuardedLink can_link(const std::string& name, const std::vector<unsigned>& addresses);
  /// The same link while it is not there: the drives' end stays as it is.
  static runtime::GuardedLink absent_link(const std::string& name,
                                          const std::vector<unsigned>& addresses);
  /// Frames that came at the drives' end of `name` since the last look.
  std::vector<unsigned> frames(const std::string& name);
  bool hand_over(std::vector<runtime::GuardedLink> links);
  /// "can0" with one axis, 0x2D.
  bool hand_over_one_drive();
  runtime::GuardClient& client() { return *client_; }
  /// However late its answer is.
  link::UniqueFd borrow(const std::string& name) {
    return client_->borrow(name, [] {});
  }
  GuardShared& shared() { return memory_->shared(); }
  /// droverd is started again: other memory, another connection.
  void new_daemon();
  /// The heartbeat of droverd, for so long or until `done`; true when done.
  bool beat(std::chrono::milliseconds time, const std::function<bool()>& done = {});
  static bool wait_until(const std::function<bool()>& done);
  /// One word to the stop socket; the answer.
  std::string at_stop_socket(const std::string& word) const;
  std::string output() const;
  std::string file(const char* name) const { return (folder_ / name).string(); }

 private:
  /// An own connection; none as long as nobody listens there.
  link::UniqueFd to_stop_socket() const;

  std::filesystem::path folder_;
  pid_t pid_ = -1;
  std::unique_ptr<runtime::GuardMemory> memory_;
  std::unique_ptr<runtime::GuardClient> client_;
  std::vector<std::pair<std::string, link::UniqueFd>> drives_;
};

}  // namespace drover::test
