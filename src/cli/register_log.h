// Recorded registers of a Modbus device, a line each: frames of Modbus RTU, or addresses and words.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drover/driver.h"

namespace drover::cli {

/// Keeps what was read last from each register, whatever blocks the recorded master asked for.
///
/// A line is one of
///   D2 03 06 02 12 74 D7 03 60 BA B1    a reply, its checksum included; which registers it holds
///                                       is told by the request in the line before, or else by its
///                                       length, when one block of the map has that length
///   D2 03 00 28 00 03 96 60             a request
///   0x0028: 0212 74D7 0360              words from an address on, in hexadecimal; "4/0x0028:"
///                                       when they were read with function 4
class RegisterLog final {
 public:
  RegisterLog(std::span<const RegisterBlock> blocks, std::uint8_t stride)
      : blocks_(blocks), stride_(stride) {}

  /// Empty, or what is wrong with the line.
  std::string add(std::string_view line);
  /// True once after each round: every register of every block was seen since the last one.
  bool complete();
  std::vector<std::uint16_t> words(std::size_t block) const;
  /// The first register that never came: "0x0039 (function 3)"; empty when all did.
  std::string never_seen() const;

 private:
  using Key = std::pair<std::uint8_t, std::uint16_t>;  ///< function and address
  std::string add_frame(const std::vector<std::uint8_t>& bytes);
  std::string add_words(std::string_view head, std::string_view words);
  void store(std::uint8_t function, std::uint16_t address, std::span<const std::uint16_t> words);
  Key key(const RegisterBlock& block, std::size_t index) const;

  std::span<const RegisterBlock> blocks_;
  std::set<Key> fresh_;  ///< registers of this round
  std::map<Key, std::uint16_t> image_;
  std::optional<RegisterBlock> request_;
  std::uint8_t stride_;
};

}  // namespace drover::cli
