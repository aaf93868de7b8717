// Numbers and texts as bytes and back: without allocation, with one error that stays.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace drover::gateway {

/// Not-a-number has many bit patterns and one meaning.
inline std::uint64_t bits_of(double value) {
  return std::bit_cast<std::uint64_t>(std::isnan(value) ? std::numeric_limits<double>::quiet_NaN()
                                                        : value);
}

/// Small numbers of either sign become small.
constexpr std::uint64_t folded(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63U);
}
constexpr std::int64_t unfolded(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1U) ^ (~(value & 1U) + 1U));
}

/// Writes into a buffer of the caller's; what does not fit makes it bad, and nothing follows.
class ByteWriter final {
 public:
  explicit ByteWriter(std::span<std::uint8_t> buffer) : buffer_(buffer) {}
  void byte(std::uint8_t value) {
    if (size_ == buffer_.size()) bad_ = true;
    if (!bad_) buffer_[size_++] = value;
  }
  /// Seven bits a byte, the lowest first; the top bit says that more follow.
  void number(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) byte(static_cast<std::uint8_t>(value | 0x80U));
    byte(static_cast<std::uint8_t>(value));
  }
  void signed_number(std::int64_t value) { number(folded(value)); }
  void real(double value) { raw(bits_of(value)); }
  void raw(std::uint64_t bits) {
    for (unsigned i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  void bytes(std::span<const std::uint8_t> values) {
    if (values.size() > buffer_.size() - size_) bad_ = true;
    if (bad_) return;
    for (const auto value : values) buffer_[size_++] = value;
  }
  /// Its length first.
  void blob(std::span<const std::uint8_t> values) {
    number(values.size());
    bytes(values);
  }
  void text(std::string_view value) {
    blob({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()});
  }
  void fail() { bad_ = true; }
  bool good() const { return !bad_; }
  std::span<const std::uint8_t> written() const { return buffer_.first(size_); }

 private:
  std::span<std::uint8_t> buffer_;
  std::size_t size_ = 0;
  bool bad_ = false;
};

/// Reads what a ByteWriter wrote, or anything else: past the end, or where a length is too long,
/// it is bad from there on and gives zeros and nothing.
class ByteReader final {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  std::uint8_t byte() {
    if (left_.empty()) bad_ = true;
    if (bad_) return 0;
    const auto value = left_.front();
    left_ = left_.subspan(1);
    return value;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto part = byte();
      value |= std::uint64_t{part & 0x7FU} << shift;
      if ((part & 0x80U) == 0) return value;
    }
    bad_ = true;
    return 0;
  }
  std::int64_t signed_number() { return unfolded(number()); }
  double real() { return std::bit_cast<double>(raw()); }
  std::uint64_t raw() {
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{byte()} << (8 * i);
    return bits;
  }
  std::span<const std::uint8_t> bytes(std::size_t count) {
    if (count > left_.size()) bad_ = true;
    if (bad_) return {};
    const auto values = left_.first(count);
    left_ = left_.subspan(count);
    return values;
  }
  std::span<const std::uint8_t> blob() { return bytes(static_cast<std::size_t>(number())); }
  std::string_view text() {
    const auto values = blob();
    return {reinterpret_cast<const char*>(values.data()), values.size()};
  }
  /// A number below `end`, or bad.
  std::uint64_t below(std::uint64_t end) {
    const auto value = number();
    if (value < end) return value;
    bad_ = true;
    return 0;
  }
  void fail() { bad_ = true; }
  bool good() const { return !bad_; }
  std::span<const std::uint8_t> left() const { return left_; }
  /// All was read, and well.
  bool done() const { return good() && left_.empty(); }

 private:
  std::span<const std::uint8_t> left_;
  bool bad_ = false;
};

}  // namespace drover::gateway
