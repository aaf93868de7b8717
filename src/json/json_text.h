// Writes JSON text: commas, escapes and numbers that read back to the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace drover::json {

/// Appends to a text. The caller keeps brackets balanced.
class JsonText {
 public:
  JsonText& open(char bracket);   ///< '{' or '['
  JsonText& close(char bracket);  ///< '}' or ']'
  JsonText& key(std::string_view name);
  /// Quoted and escaped; bytes that are no UTF-8 become U+FFFD.
  JsonText& text(std::string_view value);
  JsonText& boolean(bool value);
  JsonText& integer(std::int64_t value);
  /// Shortest digits that give the same double again. JSON has no NaN or infinity: they become 0,
  /// so the caller decides first what stands for "absent".
  JsonText& number(double value);
  /// Rounded to so many decimals (0 to 15), without the zeros behind; never "-0".
  JsonText& number(double value, int decimals);
  /// A number in its own spelling, which is one of JSON's.
  JsonText& spelled_number(std::string_view digits);
  JsonText& null();
  JsonText& newline();

  void reserve(std::size_t bytes) { out_.reserve(bytes); }
  const std::string& str() const { return out_; }
  std::string take() { return std::move(out_); }

 private:
  void separate();

  std::string out_;
  bool comma_ = false;
};

}  // namespace drover::json
