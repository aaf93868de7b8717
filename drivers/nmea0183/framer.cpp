// The framer's state machine; every byte leads to a defined state.
#include "drivers/nmea0183/framer.h"

#include <algorithm>
#include <cstring>

#include "drivers/nmea0183/block.h"

namespace drover::nmea0183 {
namespace {

constexpr std::uint8_t kSumDigits = 2;
constexpr std::uint8_t kCrcDigits = 8;

int hex_value(std::uint8_t byte) {
  if (byte >= '0' && byte <= '9') return byte - '0';
  if (byte >= 'A' && byte <= 'F') return byte - 'A' + 10;
  if (byte >= 'a' && byte <= 'f') return byte - 'a' + 10;
  return -1;
}

// Unicore's replies count the leading `$` into the XOR; they are no damaged sentences.
bool is_reply(std::string_view body) {
  return body.starts_with("command,") || body.starts_with("CONFIG,");
}

/// Bytes that are a sentence's text and nothing else.
constexpr auto kText = [] {
  std::array<bool, 256> text{};
  for (std::size_t byte = 0x20; byte <= 0x7E; ++byte)
    text[byte] = byte != '$' && byte != '*' && byte != '#';
  return text;
}();

/// What is no such byte.
Block marks_of(Block bytes) {
  return (bytes < 0x20) | (bytes == 0x7F) | (bytes == '$') | (bytes == '*') | (bytes == '#');
}

}  // namespace

std::size_t Framer::take_dull(std::span<const std::uint8_t> bytes) {
  if (state_ == State::checksum) return 0;
  if (state_ == State::idle)
    return static_cast<std::size_t>(std::find(bytes.begin(), bytes.end(), '$') - bytes.begin());
  const std::size_t text = take_text(bytes.first(std::min(bytes.size(), kMaxBody - size_)));
  return text + take_sum(bytes.subspan(text));
}

std::size_t Framer::take_text(std::span<const std::uint8_t> bytes) {
  std::size_t count = 0;
  Block sums{};
  std::size_t dull = kBlock;
  for (; dull == kBlock && bytes.size() - count >= kBlock; count += dull) {
    const Block text = load_block(&bytes[count]);
    dull = before_first(marks_of(text));
    sums ^= text & first_of_block(dull);
  }
  sum_ = static_cast<std::uint8_t>(sum_ ^ folded(sums));
  for (; dull == kBlock && count < bytes.size() && kText[bytes[count]]; ++count)
    sum_ = static_cast<std::uint8_t>(sum_ ^ bytes[count]);
  if (count > 0) std::memcpy(&buffer_[size_], bytes.data(), count);
  size_ += count;
  return count;
}

/// The end of the text with the digits behind it, where all of them are there.
std::size_t Framer::take_sum(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kWhole = 1 + kSumDigits;
  if (bytes.size() < kWhole || bytes[0] != '*') return 0;
  const int high = hex_value(bytes[1]);
  const int low = hex_value(bytes[2]);
  if (high < 0 || low < 0) return 0;
  state_ = State::checksum;
  digits_ = kSumDigits;
  claimed_ = static_cast<std::uint32_t>(high << 4 | low);
  return kWhole;
}

Framer::Event Framer::push(std::uint8_t byte) {
  if (byte == '$') {
    // A new start inside a line means that the old line was cut: the new one may still be whole.
    const bool cut = state_ != State::idle;
    state_ = State::body;
    size_ = 0;
    sum_ = 0;
    digits_ = 0;
    claimed_ = 0;
    return cut ? Event::dropped : Event::none;
  }
  if (state_ == State::idle) return Event::none;
  if (state_ == State::body) {
    if (byte == '*') {
      state_ = State::checksum;
      return Event::none;
    }
    // `#` begins a log of another format; a line end here means that there is no checksum.
    if (byte < 0x20 || byte > 0x7E || byte == '#' || size_ == kMaxBody) return drop();
    buffer_[size_++] = static_cast<char>(byte);
    sum_ = static_cast<std::uint8_t>(sum_ ^ byte);
    return Event::none;
  }
  if (byte == '\r' || byte == '\n') return finish();
  const int digit = hex_value(byte);
  if (digit < 0 || digits_ == kCrcDigits) return drop();
  ++digits_;
  claimed_ = (claimed_ << 4U) | static_cast<std::uint32_t>(digit);
  return Event::none;
}

Framer::Event Framer::drop() {
  state_ = State::idle;
  return Event::dropped;
}

Framer::Event Framer::finish() {
  state_ = State::idle;
  if (digits_ == kCrcDigits) return Event::foreign;
  if (digits_ != kSumDigits) return Event::dropped;
  if (claimed_ == sum_) return Event::sentence;
  if (claimed_ == (sum_ ^ std::uint32_t{'$'}) && is_reply(body())) return Event::foreign;
  return Event::dropped;
}

}  // namespace drover::nmea0183
