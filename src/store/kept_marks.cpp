// Which files were ever written: one of them that is not there was deleted, and was not "never".
#include "store/kept_marks.h"

#include <cerrno>

namespace drover::store {
namespace {

std::string marks_of(const std::string& folder) {
  return folder + "/" + std::string(kMarksFolder);
}

int look(Files& files, const std::string& folder, const std::string& name) {
  std::string content;
  return files.read(marks_of(folder) + "/" + name, 4096, content);
}

}  // namespace

bool was_kept(Files& files, const std::string& folder, const std::string& name) {
  return look(files, folder, name) != ENOENT;
}

void mark_kept(Files& files, const std::string& folder, const std::string& name) {
  if (look(files, folder, name) != ENOENT) return;
  // An empty file is whole whenever the power goes: it needs no temporary name, that would stay.
  int descriptor = -1;
  if (files.create(marks_of(folder) + "/" + name, descriptor) != 0) return;
  (void)files.close(descriptor);
  (void)files.sync_folder(marks_of(folder));
}

std::string deleted_text(const std::string& folder, const std::string& name) {
  return folder + "/" + name + " was deleted";
}

std::string gone_text(const std::string& folder, const std::string& name) {
  return folder + "/" + name + " was damaged or deleted";
}

}  // namespace drover::store
