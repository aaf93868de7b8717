#include "runtime/memory_layout.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "link/unique_fd.h"

namespace drover::runtime {

namespace {

constexpr std::uint64_t kLayoutBefore = 0x64726d656d303035;  // "drmem005"
/// Of the same size: it did not tell whether a wheel ran away.
constexpr std::uint64_t kLayoutEarlier = 0x64726d656d303034;  // "drmem004"
constexpr std::uint64_t kNoLayout = 1;

/// It did not tell where the base stood.
struct RememberedBefore {
  Reason stop;
  bool stop_at_robot = false;
  bool power_cut = false;
  bool holding = false;
  bool released = false;
  bool task = false;
  bool mechanics_proved = false;
  Reason joints_wait;
  bool at_rest = false;
  bool ran_away = false;
};

using Before = MemoryRecord<RememberedBefore>;
using Today = MemoryRecord<Remembered>;

void raise(const Before& before, Today& today) {
  if (before.never_written()) return;
  const bool known = before.format == kLayoutBefore || before.format == kLayoutEarlier;
  if (!known || before.checksum != before.sum()) {
    today.format = kNoLayout;
    return;
  }
  const RememberedBefore& kept = before.remembered;
  Remembered& now = today.remembered;
  now.stop = kept.stop;
  now.stop_at_robot = kept.stop_at_robot;
  now.power_cut = kept.power_cut;
  now.holding = kept.holding;
  now.released = kept.released;
  now.task = kept.task;
  now.mechanics_proved = kept.mechanics_proved;
  now.joints_wait = kept.joints_wait;
  now.at_rest = kept.at_rest;
  // What lay there earlier was nothing.
  now.ran_away = before.format == kLayoutBefore && kept.ran_away;
  today.format = kMemoryLayout;
  today.sequence = before.sequence;
  today.boot = before.boot;
  today.configuration = before.configuration;
  today.checksum = today.sum();
}

}  // namespace

const char* raise_memory_layout(const std::string& path) {
  const link::UniqueFd old(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (!old) return errno == ENOENT ? nullptr : "cannot open";
  std::array<Before, 2> before;
  struct stat info {};
  if (::fstat(old.get(), &info) != 0) return "cannot look at it";
  if (info.st_size != static_cast<off_t>(sizeof before)) return nullptr;
  const ssize_t got = ::read(old.get(), static_cast<void*>(before.data()), sizeof before);
  if (got != static_cast<ssize_t>(sizeof before)) return "cannot read";

  std::array<Today, 2> today;
  std::memset(static_cast<void*>(today.data()), 0, sizeof today);
  for (std::size_t i = 0; i < before.size(); ++i) raise(before[i], today[i]);
  const std::string next = path + ".new";
  const link::UniqueFd fd(
      ::open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!fd) return "cannot make anew";
  const ssize_t put = ::write(fd.get(), static_cast<const void*>(today.data()), sizeof today);
  if (put != static_cast<ssize_t>(sizeof today)) return "cannot write anew";
  return std::rename(next.c_str(), path.c_str()) == 0 ? nullptr : "cannot put in place";
}

}  // namespace drover::runtime
