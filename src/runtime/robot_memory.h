// What the gateway remembers over its own death: a small file in the run folder, mapped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/remembered.h"

namespace drover::runtime {

template <class Kept>
struct MemoryRecord;

/// Plain stores into a mapped file survive a kill, and cost the control thread no system call. Two
/// records in turn, each with a checksum: one that was being written when the program died is told
/// from the one before. The file does not outlive a boot, nor is it believed after one.
class RobotMemory final {
 public:
  /// Opens or makes `folder`/memory. What cannot be used is told in `report`: then the memory is
  /// only this program's own. `configuration`: its text; what was proved with another one is not.
  RobotMemory(const std::string& folder, const std::string& boot_id, std::string_view configuration,
              std::vector<std::string>& report);
  ~RobotMemory();
  RobotMemory(const RobotMemory&) = delete;
  RobotMemory& operator=(const RobotMemory&) = delete;

  /// What the program before this one left in the same boot; nothing when there was none.
  const std::optional<Remembered>& found() const { return found_; }
  /// There was something in the same boot, but no record is whole.
  bool unreadable() const { return unreadable_; }
  /// One record is not whole, and it may be the newest.
  bool damaged() const { return damaged_; }

  /// Control thread: writes when something changed. True when it did.
  bool keep(const Remembered& now);

 private:
  using Record = MemoryRecord<Remembered>;
  /// Returns the step that failed, with errno; nullptr when none did.
  const char* open(const std::string& path);
  /// The newest whole one of the two records.
  void read();
  void write(const Remembered& now);

  Record* records_ = nullptr;  ///< two; nullptr: no file
  std::string boot_id_;
  std::uint64_t configuration_ = 0;
  std::uint64_t sequence_ = 0;
  std::optional<Remembered> found_;
  bool unreadable_ = false;
  bool damaged_ = false;
  std::optional<Remembered> last_;
};

/// The kernel's name for this boot of the computer.
std::string boot_id();

/// What the gateway is to be told at its start: the memory of this boot, else what the disk keeps.
/// What cannot be read counts as a stop.
Remembered recall(const RobotMemory& memory, const Remembered& on_disk);

}  // namespace drover::runtime
