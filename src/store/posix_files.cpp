// The real file system: each method is one system call, repeated where a signal cut it short.
#include "store/posix_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

namespace drover::store {
namespace {

int result(int value) {
  return value < 0 ? errno : 0;
}

int open_again(const std::string& path, int flags, mode_t mode = 0) {
  int descriptor = -1;
  do {
    descriptor = ::open(path.c_str(), flags | O_CLOEXEC, mode);
  } while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/// A regular file, and its size.
int open_file(const std::string& path, int& descriptor, std::size_t& size) {
  // O_NONBLOCK: a pipe in this place must not hold the start-up.
  descriptor = open_again(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return errno;
  struct stat info {};
  const int error = result(::fstat(descriptor, &info));
  size = static_cast<std::size_t>(info.st_size);
  return error == 0 && !S_ISREG(info.st_mode) ? EINVAL : error;
}

/// Until it ends, or `content` has as many.
int read_up_to(int descriptor, std::size_t bytes, std::string& content) {
  std::array<char, 65536> buffer{};
  while (content.size() < bytes) {
    const ssize_t got =
        ::read(descriptor, buffer.data(), std::min(buffer.size(), bytes - content.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno;
    if (got == 0) break;
    content.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return 0;
}

}  // namespace

int PosixFiles::make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0750) == 0) return 0;
  if (errno != EEXIST) return errno;
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return errno;
  return S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
}

int PosixFiles::list(const std::string& folder, std::vector<std::string>& names) {
  names.clear();
  DIR* handle = ::opendir(folder.c_str());
  if (handle == nullptr) return errno;
  int error = 0;
  for (;;) {
    errno = 0;
    const dirent* entry = ::readdir(handle);
    if (entry == nullptr) {
      error = errno;
      break;
    }
    if (entry->d_type != DT_DIR) names.emplace_back(entry->d_name);
  }
  ::closedir(handle);
  return error;
}

int PosixFiles::read(const std::string& path, std::size_t max_bytes, std::string& content) {
  content.clear();
  int descriptor = -1;
  std::size_t size = 0;
  int error = open_file(path, descriptor, size);
  if (error == 0 && size > max_bytes) error = EFBIG;
  if (error == 0) error = read_up_to(descriptor, max_bytes + 1, content);
  if (error == 0 && content.size() > max_bytes) error = EFBIG;  // it grew
  if (descriptor >= 0) ::close(descriptor);
  return error;
}

int PosixFiles::read_front(const std::string& path, std::size_t bytes, std::string& content) {
  content.clear();
  int descriptor = -1;
  std::size_t size = 0;
  int error = open_file(path, descriptor, size);
  if (error == 0) error = read_up_to(descriptor, bytes, content);
  if (descriptor >= 0) ::close(descriptor);
  return error;
}

int PosixFiles::create(const std::string& path, int& descriptor) {
  descriptor = open_again(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0640);
  return result(descriptor);
}

int PosixFiles::write(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return EIO;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int PosixFiles::sync(int descriptor) {
  return result(::fsync(descriptor));
}

int PosixFiles::close(int descriptor) {
  return result(::close(descriptor));
}

int PosixFiles::rename(const std::string& from, const std::string& to) {
  return result(std::rename(from.c_str(), to.c_str()));
}

int PosixFiles::remove(const std::string& path) {
  return result(::unlink(path.c_str()));
}

int PosixFiles::sync_folder(const std::string& path) {
  const int descriptor = open_again(path, O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return errno;
  const int error = result(::fsync(descriptor));
  ::close(descriptor);
  return error;
}

}  // namespace drover::store
