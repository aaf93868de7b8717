// A short text inside itself: reasons and names on paths that must not allocate.
#pragma once

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <string_view>

namespace drover {

template <std::size_t N>
class FixedText {
 public:
  static constexpr std::size_t capacity() { return N; }
  FixedText() = default;
  FixedText(std::string_view text) { assign(text); }
  FixedText(const char* text) { assign(text); }

  /// Copies; what does not fit is cut at a UTF-8 character boundary, and ends with "…".
  void assign(std::string_view text) {
    size_ = 0;
    append(text);
  }
  /// Behind what there is, likewise; nothing behind a cut. Not inlined: GCC 12 warns of sizes that
  /// a text inlined from another one's cannot have.
  [[gnu::noinline]] void append(std::string_view text) {
    if (is_cut()) return;
    const std::size_t fits = std::min(text.size(), N - size_);
    std::copy_n(text.data(), fits, chars_.data() + size_);
    size_ += fits;
    if (fits < text.size()) cut();
  }
  /// printf into the text; cut likewise. glibc's vsnprintf does not allocate for these.
  [[gnu::format(printf, 2, 3)]] void format(const char* pattern, ...) {
    std::array<char, N + 1> buffer{};
    va_list args;
    va_start(args, pattern);
    const int n = std::vsnprintf(buffer.data(), buffer.size(), pattern, args);
    va_end(args);
    const auto size = static_cast<std::size_t>(std::max(n, 0));
    assign(std::string_view(buffer.data(), std::min(size, N)));
    if (size > N) cut();
  }
  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }
  std::string_view view() const { return {chars_.data(), size_}; }
  operator std::string_view() const { return view(); }
  friend bool operator==(const FixedText& a, const FixedText& b) { return a.view() == b.view(); }
  friend bool operator==(const FixedText& a, std::string_view b) { return a.view() == b; }
  friend bool operator==(const FixedText& a, const char* b) { return a.view() == b; }

 private:
  static constexpr std::string_view kCut = "…";
  static_assert(N >= 2 * kCut.size());

  bool is_cut() const { return size_ + kCut.size() >= N && view().ends_with(kCut); }
  /// Of one that is full, or lacks what is left of a character.
  void cut() {
    std::size_t fits = N - kCut.size();
    while (fits > 0 && (static_cast<unsigned char>(chars_[fits]) & 0xC0U) == 0x80U) --fits;
    std::copy_n(kCut.data(), kCut.size(), chars_.data() + fits);
    size_ = fits + kCut.size();
  }

  std::array<char, N> chars_{};
  std::size_t size_ = 0;
};

/// A sentence that an operator understands.
using Reason = FixedText<160>;
/// A joint, line or link name.
using Name = FixedText<48>;

}  // namespace drover
