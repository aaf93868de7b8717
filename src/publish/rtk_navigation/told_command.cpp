// Which command a text tells that is no JSON, or not as it should be: as far as it can be read.
#include "publish/rtk_navigation/told_command.h"

#include <algorithm>

#include "text/letters.h"

namespace drover::publish {
namespace {

bool is_quote(char c) {
  return c == '"' || c == '\'';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}
/// What may stand between a key and its value.
bool joins(char c) {
  return c == ':' || c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

}  // namespace

std::string_view ToldCommands::next() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_quote(c) || is_letter(c)) {
      const auto word = read_word();
      const bool is_value = is_cmd_;
      is_cmd_ = !is_value && depth_ <= 1 && text::equal_but_for_case(word, "cmd");
      if (is_value && !word.empty()) return word;
    } else if (c != '/' || !skip_comment()) {
      if (c == '{') ++depth_;
      if (c == '}') --depth_;
      is_cmd_ = is_cmd_ && joins(c);
      ++at_;
    }
  }
  return {};
}

/// A comment may quote a command.
bool ToldCommands::skip_comment() {
  const bool line = text_.substr(at_, 2) == "//";
  if (!line && text_.substr(at_, 2) != "/*") return false;
  const auto end = text_.find(line ? "\n" : "*/", at_ + 2);
  at_ = end == text_.npos ? text_.size() : end + (line ? 1 : 2);
  return true;
}

/// With its quotes, or as many letters as there are. The last may be cut off.
std::string_view ToldCommands::read_word() {
  const char quote = text_[at_];
  const auto begin = is_quote(quote) ? at_ + 1 : at_;
  auto end = begin;
  if (is_quote(quote)) {
    for (; end < text_.size() && text_[end] != quote; ++end) end += text_[end] == '\\' ? 1 : 0;
    end = std::min(end, text_.size());
    at_ = end + 1;
  } else {
    while (end < text_.size() && is_letter(text_[end])) ++end;
    at_ = end;
  }
  return text_.substr(begin, end - begin);
}

}  // namespace drover::publish
