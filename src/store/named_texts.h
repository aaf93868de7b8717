// Texts that the store does not understand, by kind and name, in one durable file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/result.h"
#include "store/durable_file.h"
#include "store/files.h"

namespace drover::store {

struct NamedText {
  std::string kind;      ///< a word of the caller's; names of different kinds do not meet
  std::string name;      ///< UTF-8
  double arrived_s = 0;  ///< wall time since the epoch
  std::string text;      ///< any bytes
  friend bool operator==(const NamedText&, const NamedText&) = default;
};

/// Where they lie, and how much of them there may be.
struct NamedTextsFile {
  std::string_view file;    ///< name in the folder
  std::string_view format;  ///< what the file says it is
  std::size_t max_texts = 0;
  std::size_t max_bytes = 0;  ///< of the whole file
};

/// Fails when there are too many or too large, two have kind and name in common, or one would not
/// read back as it is.
Result<std::string, Failure> encode_named_texts(const NamedTextsFile& file,
                                                const std::vector<NamedText>& texts);
/// The failure says what is wrong with the file, without its name.
Result<std::vector<NamedText>, Failure> decode_named_texts(const NamedTextsFile& file,
                                                           std::string_view content);

struct LoadedTexts {
  /// Empty: `texts` is all that was ever acknowledged. Else why nobody knows it: damaged, or it
  /// cannot be read.
  std::string problem = {};
  bool is_there = false;    ///< there is such a file
  bool is_damaged = false;  ///< what is on the disk can never be read; false: perhaps later
  bool is_foreign = false;  ///< it belongs to another user: a person mends that, and all is there
  std::vector<NamedText> texts = {};
};
/// Changes nothing on the disk.
LoadedTexts load_named_texts(Files& files, const std::string& folder, const NamedTextsFile& file);

/// Replaces all. Returns nothing when it is durable.
std::optional<Failure> save_named_texts(Files& files, const std::string& folder,
                                        const NamedTextsFile& file,
                                        const std::vector<NamedText>& texts);

/// What interrupted saves of it have left; nothing of that was acknowledged.
void remove_leftovers(Files& files, const std::string& folder, const NamedTextsFile& file);

}  // namespace drover::store
