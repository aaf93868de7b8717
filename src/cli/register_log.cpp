#include "cli/register_log.h"

#include <charconv>

#include "cli/hex.h"
#include "drover/bytes.h"
#include "drover/checksum.h"
#include "json/located_json.h"
#include "text/trimmed.h"

namespace drover::cli {

namespace {

constexpr std::size_t kRequestSize = 8;
constexpr std::size_t kReplyFrame = 5;  // unit, function, count, two bytes of checksum

/// What a logger writes before and behind the bytes themselves.
std::string_view without_decoration(std::string_view text) {
  for (const std::string_view arrow : {">>>", "<<<"})
    if (const auto at = text.find(arrow); at != std::string_view::npos) text.remove_prefix(at + 3);
  if (const auto count = text.find('('); count != std::string_view::npos)
    text = text.substr(0, count);
  return text;
}

std::optional<std::vector<std::uint8_t>> parse_bytes(std::string_view text) {
  constexpr std::string_view kBetween = " \t\r.,:;-|[]{}\"'";
  std::string digits;
  while (!text.empty()) {
    const auto begin = text.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) break;
    text.remove_prefix(begin);
    auto token = text.substr(0, text.find_first_of(kBetween));
    text.remove_prefix(token.size());
    const bool prefixed = token.starts_with("0x") || token.starts_with("0X");
    if (prefixed) token.remove_prefix(2);
    if (token.size() == 1 && prefixed) digits += '0';
    if (token.empty() || (token.size() % 2 != 0 && !(prefixed && token.size() == 1)))
      return std::nullopt;
    digits += token;
  }
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    const auto byte = from_hex(std::string_view(digits).substr(i, 2));
    if (!byte) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(*byte));
  }
  if (bytes.empty()) return std::nullopt;
  return bytes;
}

/// Hexadecimal behind 0x, else decimal. "0028" is either, and nobody guesses which.
std::optional<std::uint16_t> address_of(std::string_view text) {
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (hexadecimal) text.remove_prefix(2);
  if (!hexadecimal && text.size() > 1 && text.front() == '0') return std::nullopt;
  std::uint16_t address = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, address, hexadecimal ? 16 : 10);
  if (error != std::errc() || stop != end) return std::nullopt;
  return address;
}

}  // namespace

std::string RegisterLog::add(std::string_view line) {
  const auto bare = without_decoration(line);
  // One colon stands behind an address; several stand between bytes.
  const auto colon = bare.find(':');
  if (bare.data() == line.data() && colon != std::string_view::npos &&
      bare.find(':', colon + 1) == std::string_view::npos)
    return add_words(bare.substr(0, colon), bare.substr(colon + 1));
  const auto bytes = parse_bytes(bare);
  return bytes ? add_frame(*bytes) : "neither bytes in hexadecimal nor ADDRESS: WORDS";
}

std::string RegisterLog::add_words(std::string_view head, std::string_view words) {
  head = text::trimmed(head);
  std::uint8_t function = 3;
  if (const auto slash = head.find('/'); slash != std::string_view::npos) {
    const auto said = text::trimmed(head.substr(0, slash));
    if (said != "3" && said != "4") return "the function is neither 3 nor 4";
    function = said == "3" ? 3 : 4;
    head = text::trimmed(head.substr(slash + 1));
  }
  if (head.empty()) return "no address before the colon";
  const auto address = address_of(head);
  if (!address)
    return "\"" + json::shown(head, 20) + "\" is no address: 40 is decimal, 0x28 is hexadecimal";
  std::vector<std::uint16_t> values;
  while (!words.empty()) {
    const auto begin = words.find_first_not_of(" ,\t\r");
    if (begin == std::string_view::npos) break;
    words.remove_prefix(begin);
    const auto word = words.substr(0, words.find_first_of(" ,\t\r"));
    const auto value = from_hex(word.starts_with("0x") ? word.substr(2) : word);
    if (!value || *value > 0xFFFF) return "\"" + json::shown(word, 20) + "\" is no word";
    values.push_back(static_cast<std::uint16_t>(*value));
    words.remove_prefix(word.size());
  }
  if (values.empty()) return "no words behind the colon";
  store(function, *address, values);
  return "";
}

std::string RegisterLog::add_frame(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < kReplyFrame) return "too short for a frame of Modbus RTU";
  const auto body = std::span(bytes).first(bytes.size() - 2);
  if (modbus_crc(body) != load_le<std::uint16_t>(bytes, body.size())) return "wrong checksum";
  const auto function = bytes[1];
  if ((function & 0x80U) != 0) {
    unit_ = bytes[0];
    request_.reset();
    return "the device refused: exception " + std::to_string(bytes[2]);
  }
  if (function != 3 && function != 4) return "not a reading of registers";
  // A reply of that size would hold half a register.
  if (bytes.size() == kRequestSize) {
    request_ =
        RegisterBlock{function, load_be<std::uint16_t>(bytes, 2), load_be<std::uint16_t>(bytes, 4)};
    return "";
  }
  const std::size_t count = bytes[2] / 2U;
  if (bytes[2] % 2 != 0 || bytes.size() != kReplyFrame + bytes[2]) return "wrong length";
  std::vector<std::uint16_t> words;
  for (std::size_t i = 0; i < count; ++i) words.push_back(load_be<std::uint16_t>(bytes, 3 + 2 * i));
  unit_ = bytes[0];
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

void RegisterLog::store(std::uint8_t function, std::uint16_t address,
                        std::span<const std::uint16_t> words) {
  // The same read again: the master has begun its next round.
  if (!reads_.insert({function, address, words.size()}).second) {
    ended_ = std::exchange(round_, {});
    reads_ = {{function, address, words.size()}};
  }
  for (std::size_t i = 0; i < words.size(); ++i)
    round_[{function, static_cast<std::uint16_t>(address + i * stride_)}] = words[i];
}

bool RegisterLog::complete() const {
  for (const auto& block : blocks_)
    for (std::size_t i = 0; i < block.count; ++i)
      if (round_.count({block.function, static_cast<std::uint16_t>(block.address + i * stride_)}) ==
          0)
        return false;
  return true;
}

RegisterImage RegisterLog::take_complete() {
  if (!complete()) return {};
  reads_.clear();
  return std::exchange(round_, {});
}

}  // namespace drover::cli
