// What the disk did not take, in the run folder (memory): it outlives the program, not a boot.
#include "store/spare_texts.h"

#include <utility>

namespace drover::store {

SpareTexts::SpareTexts(Files& files, std::string folder, const NamedTextsFile& file)
    : files_(files), folder_(std::move(folder)), file_(file) {}

LoadedTexts SpareTexts::load() {
  if (folder_.empty()) return {};
  remove_leftovers(files_, folder_, file_);
  auto found = load_named_texts(files_, folder_, file_);
  is_there_ = found.is_there;
  return found;
}

void SpareTexts::before_save(const std::vector<NamedText>& texts) {
  if (is_there_) write(texts);
}

void SpareTexts::after_save(const std::vector<NamedText>& texts, bool durable) {
  if (durable && is_there_) remove();
  if (!durable && !is_there_) write(texts);
}

/// An old copy beside a newer disk would be believed: when it cannot be replaced it goes.
void SpareTexts::write(const std::vector<NamedText>& texts) {
  if (folder_.empty()) return;
  is_there_ = !save_named_texts(files_, folder_, file_, texts);
  if (!is_there_) remove();
}

void SpareTexts::remove() {
  is_there_ = files_.remove(folder_ + "/" + std::string(file_.file)) != 0;
}

}  // namespace drover::store
