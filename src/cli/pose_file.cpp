#include "cli/pose_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

namespace drover::cli {

namespace fs = std::filesystem;

PoseFile::PoseFile(std::string path, const std::string& source) : path_(std::move(path)) {
  if (!is_printed()) open(source);
}

PoseFile::~PoseFile() {
  std::error_code ignored;
  if (!beside_.empty()) fs::remove(beside_, ignored);
}

void PoseFile::open(const std::string& source) {
  std::error_code error;
  if (fs::equivalent(path_, source, error)) {
    problem_ = path_ + ": is what is read; name another file";
    return;
  }
  // What is no file, as a pipe or /dev/null, has nothing to lose, and a link stays one.
  const bool in_place = fs::exists(path_, error) && !fs::is_regular_file(path_, error);
  if (!in_place && fs::is_symlink(path_, error)) {
    const auto meant = fs::weakly_canonical(path_, error);
    if (!error) path_ = meant.string();
  }
  const std::string name = in_place ? path_ : path_ + ".part";
  if (fs::equivalent(name, source, error)) {
    problem_ = name + ": is what is read, and would be written over";
    return;
  }
  file_.open(name);
  if (!file_) {
    problem_ = name + ": cannot be written: " + std::strerror(errno);
  } else if (!in_place) {
    beside_ = name;
  }
}

std::ostream& PoseFile::stream() {
  if (is_printed()) return std::cout;
  return file_;
}

std::string PoseFile::finish() {
  stream().flush();
  if (!stream()) return (is_printed() ? "standard output" : path_) + ": cannot be written";
  if (beside_.empty()) return "";
  file_.close();
  std::error_code error;
  if (file_) fs::rename(beside_, path_, error);
  if (!file_ || error) return path_ + ": cannot be written" + (error ? ": " + error.message() : "");
  beside_.clear();
  return "";
}

}  // namespace drover::cli
