// Finds NMEA 0183 sentences in a stream of bytes, whatever lies between them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace drover::nmea0183 {

/// A sentence is `$`, printable text, `*`, two hex digits and CR and/or LF. Its text may be far
/// longer than the standard's 82 bytes: RTK receivers send lines of 92 bytes and more.
class Framer final {
 public:
  static constexpr std::size_t kMaxBody = 1024;

  enum class Event : std::uint8_t {
    none,      ///< nothing finished with this byte
    sentence,  ///< body() holds a sentence whose checksum is right
    foreign,   ///< a whole line of another kind: 32-bit check, or a receiver's reply to a command
    dropped,   ///< a line that had begun was cut, too long, unprintable or fails its checksum
  };

  Event push(std::uint8_t byte);
  /// How many bytes at the beginning of `bytes` lead to nothing but Event::none, and takes them:
  /// text inside a sentence with its checksum, or what lies between two. They are most of a stream,
  /// and so go fast.
  std::size_t take_dull(std::span<const std::uint8_t> bytes);
  /// Between `$` and `*`, after Event::sentence and until the next push().
  std::string_view body() const { return {buffer_.data(), size_}; }
  /// Forgets a line that has begun.
  void reset() { state_ = State::idle; }

 private:
  enum class State : std::uint8_t { idle, body, checksum };

  std::size_t take_text(std::span<const std::uint8_t> bytes);
  std::size_t take_sum(std::span<const std::uint8_t> bytes);
  Event drop();
  Event finish();

  std::array<char, kMaxBody> buffer_{};
  std::size_t size_ = 0;
  State state_ = State::idle;
  std::uint8_t sum_ = 0;
  std::uint8_t digits_ = 0;
  std::uint32_t claimed_ = 0;
};

}  // namespace drover::nmea0183
