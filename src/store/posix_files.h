// The real file system.
#pragma once

#include "store/files.h"

namespace drover::store {

class PosixFiles final : public Files {
 public:
  int make_folder(const std::string& path) override;
  int list(const std::string& folder, std::vector<std::string>& names) override;
  int read(const std::string& path, std::size_t max_bytes, std::string& content) override;
  int read_front(const std::string& path, std::size_t bytes, std::string& content) override;
  int create(const std::string& path, int& descriptor) override;
  int write(int descriptor, std::string_view content) override;
  int sync(int descriptor) override;
  int close(int descriptor) override;
  int rename(const std::string& from, const std::string& to) override;
  int remove(const std::string& path) override;
  int sync_folder(const std::string& path) override;
};

}  // namespace drover::store
