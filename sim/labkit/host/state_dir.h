// The folder of one running lab: created locked, removed at the end, swept when its owner died.
#pragma once

#include <string>

#include "fd.h"
#include "options.h"

namespace drover::lab {

class StateDir final {
 public:
  /// Makes base_dir (mode 0700, must belong to the caller) and a folder named by the process id.
  /// Folders whose lock is free belong to a lab that was killed and are removed first.
  explicit StateDir(const std::string& base_dir);
  StateDir(const StateDir&) = delete;
  StateDir& operator=(const StateDir&) = delete;
  ~StateDir();

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const;
  /// Empty when the file is not there.
  std::string read(const std::string& name) const;

 private:
  std::string path_;
  Fd lock_;
};

/// A host CPU of this process's own affinity mask that no other lab of this user has locked.
struct CpuLease {
  int cpu = 0;
  Fd lock;
};

/// `wanted` < 0 chooses; when every CPU is taken the labs share one, chosen by process id.
CpuLease lease_cpu(const std::string& base_dir, int wanted);

}  // namespace drover::lab
