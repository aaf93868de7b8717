#include "cli/register_log.h"

#include <cctype>
#include <cstdio>

#include "cli/hex.h"
#include "config/located_json.h"

namespace drover::cli {

namespace {

constexpr std::size_t kRequestSize = 8;
constexpr std::size_t kReplyFrame = 5;  // unit, function, count, two bytes of checksum

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const auto byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
}

std::optional<std::vector<std::uint8_t>> parse_bytes(std::string_view text) {
  std::string digits;
  for (const char c : text)
    if (std::isspace(static_cast<unsigned char>(c)) == 0) digits += c;
  if (digits.empty() || digits.size() % 2 != 0) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const auto byte = from_hex(std::string_view(digits).substr(i, 2));
    if (!byte) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(*byte));
  }
  return bytes;
}

}  // namespace

std::string RegisterLog::add(std::string_view line) {
  if (const auto colon = line.find(':'); colon != std::string_view::npos)
    return add_words(line.substr(0, colon), line.substr(colon + 1));
  const auto bytes = parse_bytes(line);
  return bytes ? add_frame(*bytes) : "neither bytes in hexadecimal nor ADDRESS: WORDS";
}

std::string RegisterLog::add_words(std::string_view head, std::string_view words) {
  unsigned function = 3;
  unsigned address = 0;
  int used = 0;
  const std::string where(head);
  const bool with_function =
      std::sscanf(where.c_str(), " %u/%x %n", &function, &address, &used) == 2;
  if (!with_function) {
    function = 3;
    if (std::sscanf(where.c_str(), " %x %n", &address, &used) != 1)
      return "no address before the colon";
  }
  if (static_cast<std::size_t>(used) != where.size() || address > 0xFFFF) return "no such address";
  if (function != 3 && function != 4) return "the function is neither 3 nor 4";
  std::vector<std::uint16_t> values;
  while (!words.empty()) {
    const auto begin = words.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) break;
    words.remove_prefix(begin);
    const auto word = words.substr(0, words.find_first_of(" \t\r"));
    const auto value = from_hex(word);
    if (!value || *value > 0xFFFF) return "\"" + json::shown(word, 20) + "\" is no word";
    values.push_back(static_cast<std::uint16_t>(*value));
    words.remove_prefix(word.size());
  }
  if (values.empty()) return "no words behind the colon";
  store(static_cast<std::uint8_t>(function), static_cast<std::uint16_t>(address), values);
  return "";
}

std::string RegisterLog::add_frame(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < kReplyFrame) return "too short for a frame of Modbus RTU";
  const auto body = std::span(bytes).first(bytes.size() - 2);
  if (crc16(body) != (bytes[bytes.size() - 2] | bytes[bytes.size() - 1] << 8U))
    return "wrong checksum";
  const auto function = bytes[1];
  if ((function & 0x80U) != 0) {
    request_.reset();
    return "the device refused: exception " + std::to_string(bytes[2]);
  }
  if (function != 3 && function != 4) return "not a reading of registers";
  // A reply of that size would hold half a register.
  if (bytes.size() == kRequestSize) {
    request_ = RegisterBlock{function, word_at(bytes, 2), word_at(bytes, 4)};
    return "";
  }
  const std::size_t count = bytes[2] / 2U;
  if (bytes[2] % 2 != 0 || bytes.size() != kReplyFrame + bytes[2]) return "wrong length";
  std::vector<std::uint16_t> words;
  for (std::size_t i = 0; i < count; ++i) words.push_back(word_at(bytes, 3 + 2 * i));
  const auto asked = request_;
  request_.reset();
  if (asked) {
    if (asked->function != function || asked->count != count)
      return "not the answer to the request before it";
    store(function, asked->address, words);
    return "";
  }
  const RegisterBlock* found = nullptr;
  for (const auto& block : blocks_) {
    if (block.function != function || block.count != count) continue;
    if (found != nullptr) return "several blocks of the map have this length: add the requests";
    found = &block;
  }
  if (found == nullptr) return "no block of the map has this length: add the request before it";
  store(function, found->address, words);
  return "";
}

RegisterLog::Key RegisterLog::key(const RegisterBlock& block, std::size_t index) const {
  return {block.function, static_cast<std::uint16_t>(block.address + index * stride_)};
}

void RegisterLog::store(std::uint8_t function, std::uint16_t address,
                        std::span<const std::uint16_t> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Key at{function, static_cast<std::uint16_t>(address + i * stride_)};
    image_[at] = words[i];
    fresh_.insert(at);
  }
}

bool RegisterLog::complete() {
  for (const auto& block : blocks_)
    for (std::size_t i = 0; i < block.count; ++i)
      if (fresh_.count(key(block, i)) == 0) return false;
  fresh_.clear();
  return true;
}

std::vector<std::uint16_t> RegisterLog::words(std::size_t block) const {
  std::vector<std::uint16_t> values;
  for (std::size_t i = 0; i < blocks_[block].count; ++i)
    values.push_back(image_.at(key(blocks_[block], i)));
  return values;
}

std::string RegisterLog::never_seen() const {
  for (const auto& block : blocks_) {
    for (std::size_t i = 0; i < block.count; ++i) {
      const auto at = key(block, i);
      if (image_.count(at) != 0) continue;
      char out[48];
      std::snprintf(out, sizeof out, "0x%04X (function %u)", static_cast<unsigned>(at.second),
                    static_cast<unsigned>(at.first));
      return out;
    }
  }
  return "";
}

}  // namespace drover::cli
