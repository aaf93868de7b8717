// Recorded registers of a Modbus device, a line each: frames of Modbus RTU, or addresses and words.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "drover/driver.h"

namespace drover::cli {

/// Function and address of a register.
using RegisterKey = std::pair<std::uint8_t, std::uint16_t>;
using RegisterImage = std::map<RegisterKey, std::uint16_t>;

/// Collects what a recorded master read, whatever it asked for, round by round.
///
/// A line is one of
///   D2 03 06 02 12 74 D7 03 60 BA B1    a reply, its checksum included; which registers it holds
///                                       is told by the request in the line before, or else by its
///                                       length, when one block of the map has that length
///   D2 03 00 28 00 03 96 60             a request
///   0x0028: 0212 74D7 0360              words in hexadecimal from an address on, which is decimal
///                                       without 0x; "4/0x0028:" when function 4 read them
/// Bytes may be written as loggers do: ">>> 81.03.00", "D2:03:00", "0xD2, 0x03", with "(8)" behind.
class RegisterLog final {
 public:
  RegisterLog(std::span<const RegisterBlock> blocks, std::uint8_t stride)
      : blocks_(blocks), stride_(stride) {}

  /// Empty, or what is wrong with the line.
  std::string add(std::string_view line);
  /// The unit that answered last; nothing before the first answer in bytes.
  std::optional<std::uint8_t> unit() const { return unit_; }
  /// The registers of a round that the last line has ended by reading something again; else empty.
  RegisterImage take_ended() { return std::exchange(ended_, {}); }
  /// The registers of this round, once every register of the map is among them; else empty.
  RegisterImage take_complete();
  /// What is left at the end of the recording.
  RegisterImage take_rest() { return std::exchange(round_, {}); }

 private:
  using Read = std::tuple<std::uint8_t, std::uint16_t, std::size_t>;
  std::string add_frame(const std::vector<std::uint8_t>& bytes);
  std::string add_words(std::string_view head, std::string_view words);
  void store(std::uint8_t function, std::uint16_t address, std::span<const std::uint16_t> words);
  bool complete() const;

  std::span<const RegisterBlock> blocks_;
  std::uint8_t stride_;
  RegisterImage ended_;
  RegisterImage round_;
  std::set<Read> reads_;  ///< of this round
  std::optional<RegisterBlock> request_;
  std::optional<std::uint8_t> unit_;
};

}  // namespace drover::cli
