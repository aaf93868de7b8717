// Which command a text tells that is no JSON, or not as it should be: as far as it can be read.
#pragma once

#include <string_view>

namespace drover::publish {

/// Walks over the members `cmd` of the outermost object. Reads on behind what JSON forbids: commas
/// too many or too few, a brace that is missing, other quotes or none. What stands in a text, in a
/// comment or in an inner object is no command. Escapes are not resolved.
class ToldCommands {
 public:
  explicit ToldCommands(std::string_view text) : text_(text) {}
  /// The next one's word, as it is spelled; empty when there is none.
  std::string_view next();

 private:
  bool skip_comment();
  std::string_view read_word();

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;        ///< of objects
  bool is_cmd_ = false;  ///< the last word was the key, and nothing but a colon came since
};

}  // namespace drover::publish
