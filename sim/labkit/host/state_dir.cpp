// Folders and locks of running labs.
#include "state_dir.h"

#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace drover::lab {
namespace {

namespace fs = std::filesystem;

Fd try_lock(const std::string& path) {
  Fd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (fd.open() && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) fd.reset();
  return fd;
}

void make_private(const std::string& path) {
  if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) fail("cannot make " + path);
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0) fail("cannot look at " + path);
  if (!S_ISDIR(info.st_mode) || info.st_uid != ::geteuid() || (info.st_mode & 077) != 0) {
    throw std::runtime_error(path + " is not a private folder of this user: remove it");
  }
}

void sweep(const std::string& base_dir) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(base_dir, ignored)) {
    if (!entry.is_directory(ignored)) continue;
    if (try_lock(entry.path() / "lock").open()) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

StateDir::StateDir(const std::string& base_dir) {
  make_private(base_dir);
  // Creation and sweeping take turns, or a sweep could remove a folder not locked yet.
  Fd turn(::open((base_dir + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (!turn.open() || ::flock(turn.get(), LOCK_EX) != 0) fail("cannot lock " + base_dir);
  sweep(base_dir);
  path_ = base_dir + "/" + std::to_string(::getpid());
  make_private(path_);
  make_private(path_ + "/uml");
  lock_ = try_lock(path_ + "/lock");
  if (!lock_.open()) fail("cannot lock " + path_);
}

StateDir::~StateDir() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void StateDir::write(const std::string& name, const std::string& text) const {
  std::ofstream out(file(name), std::ios::binary);
  out << text;
  out.close();
  if (!out) fail("cannot write " + file(name));
}

std::string StateDir::read(const std::string& name) const {
  std::ifstream in(file(name), std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

CpuLease lease_cpu(const std::string& base_dir, int wanted) {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (::sched_getaffinity(0, sizeof mask, &mask) != 0) fail("sched_getaffinity");
  std::vector<int> allowed;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(cpu, &mask)) allowed.push_back(cpu);
  }
  if (wanted >= 0) {
    if (wanted >= CPU_SETSIZE || !CPU_ISSET(wanted, &mask)) {
      throw std::runtime_error("this process may not use CPU " + std::to_string(wanted));
    }
    return {wanted, try_lock(base_dir + "/cpu-" + std::to_string(wanted))};
  }
  for (int cpu : allowed) {
    Fd lock = try_lock(base_dir + "/cpu-" + std::to_string(cpu));
    if (lock.open()) return {cpu, std::move(lock)};
  }
  return {allowed[static_cast<std::size_t>(::getpid()) % allowed.size()], Fd()};
}

}  // namespace drover::lab
