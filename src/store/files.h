// The seam to the file system: one method per call, so that a test can fail each of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace drover::store {

/// Each call returns 0 or an errno value.
class Files {
 public:
  virtual ~Files() = default;
  /// Makes the folder if it is not there; its parent must be.
  virtual int make_folder(const std::string& path) = 0;
  /// Names of the regular files and links in a folder, unsorted.
  virtual int list(const std::string& folder, std::vector<std::string>& names) = 0;
  /// Reads a whole regular file; EFBIG when it is larger than `max_bytes`.
  virtual int read(const std::string& path, std::size_t max_bytes, std::string& content) = 0;
  /// Of a regular file the first `bytes`, or all that it has.
  virtual int read_front(const std::string& path, std::size_t bytes, std::string& content) = 0;
  /// A new empty file for writing; EEXIST when the name is taken, links are not followed.
  virtual int create(const std::string& path, int& descriptor) = 0;
  /// Writes all of it.
  virtual int write(int descriptor, std::string_view content) = 0;
  virtual int sync(int descriptor) = 0;
  virtual int close(int descriptor) = 0;
  virtual int rename(const std::string& from, const std::string& to) = 0;
  virtual int remove(const std::string& path) = 0;
  /// Makes created, renamed and removed names of the folder durable.
  virtual int sync_folder(const std::string& path) = 0;
};

}  // namespace drover::store
