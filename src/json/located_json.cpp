// Builds the tree from nlohmann's SAX events; a counting iterator tells where each token ended.
#include "json/located_json.h"

#include <nlohmann/json.hpp>
#include <unordered_set>

#include "json/slips.h"
#include "text/control.h"
#include "text/utf8.h"

namespace drover::json {
namespace {

using Backend = nlohmann::json;

/// Reads the text and counts in a place that outlives the parser's copies of it.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* count) : at_(at), count_(count) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*count_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* count_;
};

bool is_number_char(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

/// Where the next token starts: past white space, separators and comments.
std::size_t skip_to_token(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    const char c = text[at];
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ':') {
      ++at;
    } else if (text.substr(at, 2) == "//") {
      at = std::min(text.find('\n', at), text.size());
    } else if (text.substr(at, 2) == "/*") {
      const std::size_t end = text.find("*/", at + 2);
      at = end == std::string_view::npos ? text.size() : end + 2;
    } else {
      break;
    }
  }
  return at;
}

/// The backend's sentence without its numbering, its own place, and what it had read (which may be
/// a megabyte, and need not be UTF-8).
std::string plain_message(std::string_view what) {
  if (const auto end = what.find("] "); what.starts_with('[') && end != what.npos) {
    what.remove_prefix(end + 2);
  }
  if (const auto end = what.find(": "); what.starts_with("parse error") && end != what.npos) {
    what.remove_prefix(end + 2);
  }
  std::string message(what.substr(0, std::min(what.find("; last read"), std::size_t{120})));
  if (message.size() == what.size()) return message;
  // What it had read may itself speak of what is expected.
  for (const std::string_view token :
       {"string literal", "':'", "'}'", "']'", "end of input", "'[', '{', or a literal"}) {
    const std::string expected = "; expected " + std::string(token);
    if (what.ends_with(expected)) return message + expected;
  }
  return message;
}

class Builder {
 public:
  Builder(std::string_view text, const Limits& limits) : text_(text), limits_(limits) {}

  std::size_t* count() { return &consumed_; }
  JsonError refuse_nul(std::size_t at) {
    advance(at);
    (void)fail("contains a NUL byte");
    return take_error();
  }
  JsonError take_error() { return std::move(error_); }
  Document take_document() { return {std::move(root_)}; }

  // The backend's SAX events; false ends the parse.
  bool null() { return add(std::monostate{}); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value, Token::number); }
  bool number_unsigned(std::uint64_t value) {
    if (value <= static_cast<std::uint64_t>(INT64_MAX)) {
      return add(static_cast<std::int64_t>(value), Token::number);
    }
    return add(value, Token::number);
  }
  bool number_float(double value, const std::string& written) {
    if (!limits_.long_integers && written.find_first_of(".eE") == std::string::npos) {
      begin_token();
      return fail("integer does not fit into 64 bits");
    }
    return add(value, Token::number);
  }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Backend::binary_t&) { return fail("binary value"); }
  bool start_object(std::size_t) { return open(std::vector<Member>{}); }
  bool start_array(std::size_t) { return open(std::vector<Node>{}); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    begin_token();
    Frame& frame = frames_.back();
    frame.key = std::move(name);
    frame.key_line = line_;
    frame.key_column = column_;
    if (repeats(frame)) return fail("this key is there twice");
    end_token(Token::other);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const std::exception& error) {
    const std::size_t last_read = std::min(position > 0 ? position - 1 : 0, text_.size());
    advance(std::max(at_, std::min(skip_to_token(text_, at_), last_read)));
    const bool inside = !frames_.empty();
    if (auto slip = slip_at(text_, at_, inside); !slip.empty()) return fail(std::move(slip));
    return fail(in_other_words(plain_message(error.what())));
  }

 private:
  enum class Token { number, other };
  struct Frame {
    Node node;
    std::string key;  ///< of the member being read
    std::uint32_t key_line = 0;
    std::uint32_t key_column = 0;
    std::unordered_set<std::string> seen;  ///< used once the object is large
  };

  template <class T>
  bool add(T value, Token token = Token::other) {
    begin_token();
    if (!count_value()) return false;
    Node node{std::move(value), line_, column_, static_cast<std::uint32_t>(at_)};
    end_token(token);
    place(std::move(node));
    return true;
  }
  template <class T>
  bool open(T empty) {
    begin_token();
    if (!count_value()) return false;
    if (frames_.size() >= limits_.max_depth) {
      return fail("nested deeper than " + std::to_string(limits_.max_depth) + " levels");
    }
    Node node{std::move(empty), line_, column_, static_cast<std::uint32_t>(at_)};
    frames_.push_back({std::move(node), {}, 0, 0, {}});
    end_token(Token::other);
    return true;
  }
  bool close() {
    end_token(Token::other);
    Node node = std::move(frames_.back().node);
    frames_.pop_back();
    place(std::move(node));
    return true;
  }
  void place(Node node) {
    if (frames_.empty()) {
      root_ = std::move(node);
      return;
    }
    Frame& frame = frames_.back();
    if (auto* items = std::get_if<std::vector<Node>>(&frame.node.value)) {
      items->push_back(std::move(node));
    } else {
      std::get<std::vector<Member>>(frame.node.value)
          .push_back({std::move(frame.key), frame.key_line, frame.key_column, std::move(node)});
      frame.key.clear();
    }
  }
  /// Small objects are searched, large ones hashed: many keys must not cost quadratic time.
  static bool repeats(Frame& frame) {
    constexpr std::size_t kSmall = 16;
    const auto& members = std::get<std::vector<Member>>(frame.node.value);
    if (members.size() < kSmall) return frame.node.find(frame.key) != nullptr;
    if (frame.seen.empty()) {
      for (const Member& member : members) frame.seen.insert(member.key);
    }
    return !frame.seen.insert(frame.key).second;
  }
  bool count_value() {
    if (++values_ <= limits_.max_values) return true;
    return fail("more than " + std::to_string(limits_.max_values) + " values");
  }

  void begin_token() { advance(skip_to_token(text_, at_)); }
  /// The backend reads one character past a number, so its end is found in the text.
  void end_token(Token token) {
    std::size_t end = consumed_;
    if (token == Token::number) {
      for (end = at_; end < text_.size() && is_number_char(text_[end]);) ++end;
    }
    advance(end);
  }
  void advance(std::size_t to) {
    for (; at_ < to && at_ < text_.size(); ++at_) {
      const auto byte = static_cast<unsigned char>(text_[at_]);
      if (byte == '\n') {
        ++line_;
        column_ = 1;
      } else if ((byte & 0xC0U) != 0x80U) {
        ++column_;
      }
    }
  }
  bool fail(std::string message) {
    error_ = {line_, column_, path(), std::move(message)};
    return false;
  }
  std::string path() const {
    std::string path;
    for (const Frame& frame : frames_) {
      if (const auto* items = frame.node.list()) {
        path += "[" + std::to_string(items->size()) + "]";
      } else if (!frame.key.empty()) {
        path += (path.empty() ? "" : ".") + shown(frame.key, 60);
      }
    }
    return path;
  }

  std::string_view text_;
  const Limits& limits_;
  std::size_t consumed_ = 0;  ///< by the backend
  std::size_t at_ = 0;        ///< by us: the end of the last token
  std::uint32_t line_ = 1;
  std::uint32_t column_ = 1;
  std::size_t values_ = 0;
  std::vector<Frame> frames_;
  Node root_;
  JsonError error_;
};

}  // namespace

std::string JsonError::text() const {
  std::string text = "line " + std::to_string(line) + ", column " + std::to_string(column);
  if (!path.empty()) text += " (" + path + ")";
  return text + ": " + message;
}

std::string shown(std::string_view text, std::size_t max_bytes) {
  const auto beginning = text::beginning(text, max_bytes);
  auto out = text::harmless(beginning);
  return beginning.size() == text.size() ? out : out + "...";
}

Result<Document, JsonError> parse(std::string_view text, const Limits& limits) {
  if (text.size() > limits.max_bytes) {
    return JsonError{1, 1, "",
                     std::to_string(text.size()) + " bytes are more than the limit of " +
                         std::to_string(limits.max_bytes)};
  }
  if (text.starts_with("\xEF\xBB\xBF")) return JsonError{1, 1, "", "starts with a byte order mark"};
  // The backend takes a NUL byte for the end and would not see what follows.
  Builder builder(text, limits);
  if (const auto nul = text.find('\0'); nul != text.npos) return builder.refuse_nul(nul);
  const CountingIterator first(text.data(), builder.count());
  const CountingIterator last(text.data() + text.size(), builder.count());
  if (!Backend::sax_parse(first, last, &builder, Backend::input_format_t::json, true, true)) {
    return builder.take_error();
  }
  return builder.take_document();
}

std::optional<std::int64_t> Node::integer() const {
  if (const auto* small = std::get_if<std::int64_t>(&value)) return *small;
  return std::nullopt;
}

std::optional<double> Node::number() const {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return static_cast<double>(*integer);
  }
  if (const auto* big = std::get_if<std::uint64_t>(&value)) return static_cast<double>(*big);
  return std::nullopt;
}

std::string_view Node::spelling(std::string_view text) const {
  if (!number()) return {};
  const auto rest = text.substr(begin);
  const auto* const end = std::find_if_not(rest.begin(), rest.end(), is_number_char);
  return rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
}

const Node* Node::find(std::string_view key) const {
  if (const auto* members = object()) {
    for (const Member& member : *members) {
      if (member.key == key) return &member.node;
    }
  }
  return nullptr;
}

std::string_view Node::kind() const {
  constexpr std::string_view kKinds[] = {"null",     "true or false", "an integer", "an integer",
                                         "a number", "a text",        "a list",     "an object"};
  return kKinds[value.index()];
}

}  // namespace drover::json
