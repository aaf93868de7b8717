// Importing a zone: the file is read and shown to a person, who says whether it is the right place,
// and then handed to droverd, which reads it again and stores it.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace drover::cli {

struct ImportOrder {
  std::string file;
  std::string name;  ///< empty: as the file names its areas
  bool keep_in = false;
  bool yes = false;   ///< a person is not asked
  bool json = false;  ///< droverd's answer instead of words
};

/// Whom it talks to.
struct ImportTalk {
  /// One request to droverd, its answer; throws NoAnswer.
  std::function<std::string(const std::string& request)> ask;
  /// What a person answers to this question; nothing when nobody is there.
  std::function<std::optional<std::string>(const std::string& question)> ask_person;
};

/// The exit code.
int import_zone_file(const ImportOrder& order, const ImportTalk& talk, std::ostream& out,
                     std::ostream& err);

}  // namespace drover::cli
