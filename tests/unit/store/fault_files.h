// A file system in memory that fails or loses power at a chosen call and then shows what a disk
// would.
#pragma once

#include <cerrno>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "store/files.h"

namespace drover::store {

struct PowerCut {};

class FaultFiles : public Files {
 public:
  enum class Fault { none, fail, cut_before, cut_after };
  /// What reached the disk of that which was never synced.
  struct Remains {
    bool names = false;         ///< renames, creations, removals
    bool half_content = false;  ///< the first half of unsynced bytes
  };

  void plan(Fault fault, int at_call, int error = EIO) {
    fault_ = fault;
    at_call_ = at_call;
    error_ = error;
    calls_ = 0;
  }
  int calls() const { return calls_; }
  /// Nothing in `folder` can be made, renamed or removed until another one is named.
  void read_only(const std::string& folder) { read_only_ = folder; }
  void boot_after_cut(Remains remains) {
    if (!remains.names) names_ = synced_names_;
    for (auto& [path, file] : names_) {
      auto now = std::make_shared<File>();
      now->synced = file->synced;
      if (remains.half_content && file->content != file->synced) {
        now->synced = file->content.substr(0, file->content.size() / 2);
      }
      now->content = now->synced;
      file = now;
    }
    synced_names_ = names_;
    open_.clear();
    plan(Fault::none, 0);
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& [path, file] : names_) all[path] = file->content;
    return all;
  }
  void put(const std::string& path, const std::string& content) {
    names_[path] = std::make_shared<File>(File{content, content, false});
    synced_names_ = names_;
  }

  int make_folder(const std::string&) override { return 0; }
  int list(const std::string& folder, std::vector<std::string>& names) override {
    names.clear();
    for (const auto& [path, file] : names_) {
      if (path.rfind('/') == folder.size() && path.starts_with(folder)) {
        names.push_back(path.substr(folder.size() + 1));
      }
    }
    return 0;
  }
  int read(const std::string& path, std::size_t max_bytes, std::string& content) override {
    const auto it = names_.find(path);
    if (it == names_.end()) return ENOENT;
    content = it->second->content;
    read_bytes_ += content.size();
    return content.size() > max_bytes ? EFBIG : 0;
  }
  int read_front(const std::string& path, std::size_t bytes, std::string& content) override {
    const auto it = names_.find(path);
    if (it == names_.end()) return ENOENT;
    content = it->second->content.substr(0, bytes);
    read_bytes_ += content.size();
    return 0;
  }
  /// By `read` and `read_front`, since it was asked before.
  std::size_t read_bytes() { return std::exchange(read_bytes_, 0); }
  int create(const std::string& path, int& descriptor) override {
    return call([&] {
      if (is_read_only(path)) return EROFS;
      if (names_.contains(path)) return EEXIST;
      names_[path] = std::make_shared<File>();
      open_.push_back(names_[path]);
      descriptor = static_cast<int>(open_.size()) - 1;
      return 0;
    });
  }
  int write(int descriptor, std::string_view content) override {
    File& file = *open_.at(descriptor);
    const int error = call([&] {
      file.content += content;
      return 0;
    });
    if (error != 0) file.content += content.substr(0, content.size() / 3);
    return error;
  }
  /// A failed sync marks the pages clean: a later one "succeeds" and they are lost all the same.
  int sync(int descriptor) override {
    File& file = *open_.at(descriptor);
    const int error = call([&] {
      if (!file.lost) file.synced = file.content;
      return 0;
    });
    if (error != 0) file.lost = true;
    return error;
  }
  int close(int) override {
    return call([] { return 0; });
  }
  int rename(const std::string& from, const std::string& to) override {
    return call([&] {
      if (is_read_only(to)) return EROFS;
      const auto it = names_.find(from);
      if (it == names_.end()) return ENOENT;
      names_[to] = it->second;
      names_.erase(from);
      return 0;
    });
  }
  int remove(const std::string& path) override {
    return call([&] {
      if (is_read_only(path)) return EROFS;
      return names_.erase(path) == 1 ? 0 : ENOENT;
    });
  }
  int sync_folder(const std::string& folder) override {
    return call([&] {
      std::erase_if(synced_names_, [&](const auto& e) { return e.first.starts_with(folder); });
      for (const auto& [path, file] : names_) {
        if (path.starts_with(folder)) synced_names_[path] = file;
      }
      return 0;
    });
  }

 private:
  struct File {
    std::string content;
    std::string synced;
    bool lost = false;
  };

  bool is_read_only(const std::string& path) const {
    return !read_only_.empty() && path.starts_with(read_only_ + "/");
  }

  template <class Act>
  int call(Act act) {
    ++calls_;
    const bool now = calls_ == at_call_;
    if (now && fault_ == Fault::fail) return error_;
    if (now && fault_ == Fault::cut_before) throw PowerCut{};
    const int error = act();
    if (now && fault_ == Fault::cut_after) throw PowerCut{};
    return error;
  }

  std::map<std::string, std::shared_ptr<File>> names_;
  std::map<std::string, std::shared_ptr<File>> synced_names_;
  std::vector<std::shared_ptr<File>> open_;
  std::string read_only_;
  Fault fault_ = Fault::none;
  int at_call_ = 0;
  int error_ = 0;
  int calls_ = 0;
  std::size_t read_bytes_ = 0;
};

}  // namespace drover::store
