// What the gateway remembers over its own death: a small file in the run folder, mapped.
#include "runtime/robot_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "link/opened.h"
#include "link/unique_fd.h"
#include "runtime/memory_layout.h"
#include "store/durable_file.h"
#include "store/stop_store.h"

namespace drover::runtime {

std::string boot_id() {
  std::string id;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
  return id;
}

RobotMemory::RobotMemory(const std::string& folder, const std::string& boot_id,
                         std::string_view configuration, std::vector<std::string>& report)
    : boot_id_(boot_id.substr(0, std::tuple_size_v<decltype(Record::boot)> - 1)),
      configuration_(store::fingerprint(configuration)) {
  const std::string path = folder + "/memory";
  if (const char* failed = open(path)) {
    report.push_back(link::problem_text(path, failed, errno) +
                     ": a latched stop is forgotten when droverd dies");
    return;
  }
  read();
}

const char* RobotMemory::open(const std::string& path) {
  if (const char* failed = raise_memory_layout(path)) return failed;
  link::UniqueFd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!fd) return "cannot open";
  struct stat info {};
  const auto size = static_cast<off_t>(2 * sizeof(Record));
  if (::fstat(fd.get(), &info) != 0) return "cannot look at it";
  // Of a version long ago, or none yet: there is nothing in it for us.
  if (info.st_size != size && ::ftruncate(fd.get(), 0) != 0) return "cannot empty";
  // Allocated now: a full disk would be a signal later, in the control thread.
  if (info.st_size != size) {
    errno = ::posix_fallocate(fd.get(), 0, size);
    if (errno != 0) return "no room";
  }
  void* memory = ::mmap(nullptr, 2 * sizeof(Record), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_POPULATE, fd.get(), 0);
  if (memory == MAP_FAILED) return "cannot map";
  records_ = static_cast<Record*>(memory);
  return nullptr;
}

RobotMemory::~RobotMemory() {
  if (records_ != nullptr) ::munmap(records_, 2 * sizeof(Record));
}

void RobotMemory::read() {
  bool written = false;
  for (int i = 0; i < 2; ++i) {
    Record record;
    std::memcpy(static_cast<void*>(&record), &records_[i], sizeof record);
    if (record.never_written()) continue;
    written = true;
    const bool without_doubt = record.format == kMemoryLayoutWithoutDoubt;
    const bool without_how_far = record.format == kMemoryLayoutWithoutHowFar || without_doubt;
    const bool readable = record.format == kMemoryLayout || without_how_far;
    if (!readable || record.checksum != record.sum()) {
      damaged_ = true;
      continue;
    }
    if (record.sequence <= sequence_) continue;
    // What lay there was nothing.
    if (without_doubt) record.remembered.place.doubted = false;
    if (without_how_far) record.remembered.place.doubt_cm = 0;
    sequence_ = record.sequence;
    const bool this_boot = boot_id_ == std::string_view(record.boot.data());
    found_ = this_boot ? std::optional<Remembered>(record.remembered) : std::nullopt;
    // With another antenna the same base stands elsewhere.
    if (found_ && record.configuration != configuration_) {
      found_->mechanics_proved = false;
      found_->place = {.doubted = found_->place.doubted, .doubt_cm = found_->place.doubt_cm};
    }
  }
  unreadable_ = written && sequence_ == 0;
}

bool RobotMemory::keep(const Remembered& now) {
  if (last_ && *last_ == now) return false;
  last_ = now;
  if (records_ != nullptr) write(now);
  return true;
}

void RobotMemory::write(const Remembered& now) {
  Record record;
  std::memset(static_cast<void*>(&record), 0, sizeof record);
  record.format = kMemoryLayout;
  record.sequence = ++sequence_;
  std::memcpy(record.boot.data(), boot_id_.data(), boot_id_.size());
  record.configuration = configuration_;
  record.remembered = now;
  record.checksum = record.sum();
  std::memcpy(static_cast<void*>(&records_[sequence_ % 2]), &record, sizeof record);
}

Remembered recall(const RobotMemory& memory, const Remembered& on_disk) {
  if (memory.found() && !memory.damaged()) return *memory.found();
  if (!memory.found() && !memory.unreadable()) return on_disk;
  // What is damaged may have been the newest: nobody knows that there was no stop.
  Remembered known = store::unreadable_stop();
  const Remembered older = memory.found().value_or(Remembered{});
  for (const Remembered* kept : {&older, &on_disk}) {
    if (!kept->stop.empty()) known.stop = kept->stop;
    if (!kept->joints_wait.empty()) known.joints_wait = kept->joints_wait;
    known.power_cut = known.power_cut || kept->power_cut;
    known.ran_away = known.ran_away || kept->ran_away;
    known.released = known.released || kept->released;
    known.task = known.task || kept->task;
  }
  return known;
}

}  // namespace drover::runtime
