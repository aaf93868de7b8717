// The real file system: each method is one system call, repeated where a signal cut it short.
#include "store/posix_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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
  // O_NONBLOCK: a pipe in this place must not hold the start-up.
  const int descriptor = open_again(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return errno;
  struct stat info {};
  int error = result(::fstat(descriptor, &info));
  if (error == 0 && !S_ISREG(info.st_mode)) error = EINVAL;
  if (error == 0 && static_cast<std::size_t>(info.st_size) > max_bytes) error = EFBIG;
  std::array<char, 65536> buffer{};
  while (error == 0) {
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    error = result(static_cast<int>(got));
    if (got <= 0) break;
    content.append(buffer.data(), static_cast<std::size_t>(got));
    if (content.size() > max_bytes) error = EFBIG;
  }
  ::close(descriptor);
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
