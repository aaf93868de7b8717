// A file in memory, without being copied there.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "link/unique_fd.h"

namespace drover::cli {

class MappedFile final {
 public:
  explicit MappedFile(const std::string& path) {
    const link::UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat about {};
    if (!fd || ::fstat(fd.get(), &about) != 0) {
      fail(errno);
    } else if (!S_ISREG(about.st_mode)) {
      problem_ = "is no file";
    } else if (about.st_size > 0) {
      size_ = static_cast<std::size_t>(about.st_size);
      at_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd.get(), 0);
      if (at_ == MAP_FAILED) fail(errno);
    }
  }
  ~MappedFile() {
    if (at_ != MAP_FAILED) ::munmap(at_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& problem() const { return problem_; }
  std::span<const std::uint8_t> bytes() const {
    if (at_ == MAP_FAILED) return {};
    return {static_cast<const std::uint8_t*>(at_), size_};
  }

 private:
  void fail(int error) { problem_ = std::string("cannot be read: ") + std::strerror(error); }
  void* at_ = MAP_FAILED;
  std::size_t size_ = 0;
  std::string problem_;
};

}  // namespace drover::cli
