// What the disk did not take, in the run folder (memory): it outlives the program, not a boot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/files.h"
#include "store/named_texts.h"

namespace drover::store {

/// A copy of one file of texts that is there only while the disk lacks them. It is never older
/// than the disk's: what is saved while there is a copy goes into the copy first.
class SpareTexts final {
 public:
  /// `files` is borrowed for the lifetime of this object. `folder` empty: nothing is kept.
  SpareTexts(Files& files, std::string folder, const NamedTextsFile& file);

  /// The copy, when there is one; as `load_named_texts` says of a file.
  LoadedTexts load();
  /// Before the disk is to take `texts`.
  void before_save(const std::vector<NamedText>& texts);
  /// The disk did or did not take `texts`.
  void after_save(const std::vector<NamedText>& texts, bool durable);

 private:
  void write(const std::vector<NamedText>& texts);
  void remove();

  Files& files_;
  std::string folder_;
  NamedTextsFile file_;
  bool is_there_ = false;
};

}  // namespace drover::store
