// Modbus frames as bytes: read requests, and the search for their answers in whatever came in.
#include "link/modbus_frame.h"

#include <algorithm>

#include "drover/bytes.h"
#include "drover/checksum.h"

namespace drover::link {
namespace {

constexpr std::uint8_t kExceptionBit = 0x80;
constexpr std::size_t kMbapSize = 7;

bool crc_good(std::span<const std::uint8_t> frame) {
  const std::uint16_t crc = modbus_crc(frame.first(frame.size() - 2));
  return load_le<std::uint16_t>(frame, frame.size() - 2) == crc;
}

}  // namespace

std::array<std::uint8_t, kRtuRequestSize> rtu_read_request(std::uint8_t unit,
                                                           const RegisterBlock& block) {
  std::array<std::uint8_t, kRtuRequestSize> frame{unit,
                                                  block.function,
                                                  high_byte(block.address),
                                                  low_byte(block.address),
                                                  high_byte(block.count),
                                                  low_byte(block.count),
                                                  0,
                                                  0};
  const std::uint16_t crc = modbus_crc({frame.data(), 6});
  frame[6] = low_byte(crc);
  frame[7] = high_byte(crc);
  return frame;
}

std::array<std::uint8_t, kTcpRequestSize> tcp_read_request(std::uint16_t transaction,
                                                           std::uint8_t unit,
                                                           const RegisterBlock& block) {
  return {high_byte(transaction),
          low_byte(transaction),
          0,
          0,
          0,
          6,
          unit,
          block.function,
          high_byte(block.address),
          low_byte(block.address),
          high_byte(block.count),
          low_byte(block.count)};
}

FoundAnswer find_rtu_answer(std::span<const std::uint8_t> bytes, std::uint8_t unit,
                            const RegisterBlock& block) {
  FoundAnswer found;
  const auto request = rtu_read_request(unit, block);
  const std::size_t whole = 5U + 2U * block.count;
  const auto worse = [&found](Answer answer) { found.answer = std::max(found.answer, answer); };
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto rest = bytes.subspan(at);
    const bool own = rest[0] == unit;
    const bool function = rest.size() > 1 && rest[1] == block.function;
    // The answer before the echo: one may begin like the request.
    if (function && rest.size() > 2 && rest[2] == 2U * block.count) {
      if (rest.size() >= whole) {
        const bool good = crc_good(rest.first(whole));
        if (good && own) {
          found.answer = Answer::good;
          found.data = at + 3;
          return found;
        }
        if (good) worse(Answer::wrong_unit);
        if (!good && own) worse(Answer::damaged);
      }
    }
    if (own && rest.size() >= 5 && rest[1] == (block.function | kExceptionBit)) {
      if (crc_good(rest.first(5))) {
        found.answer = Answer::exception;
        found.exception = rest[2];
        return found;
      }
      worse(Answer::damaged);
    }
    if (rest.size() >= request.size() && std::equal(request.begin(), request.end(), rest.begin())) {
      ++found.echoes;
      at += request.size();
      continue;
    }
    worse(Answer::incomplete);
    ++at;
  }
  return found;
}

FoundAnswer find_tcp_answer(std::span<const std::uint8_t> bytes, std::uint16_t transaction,
                            std::uint8_t unit, const RegisterBlock& block) {
  FoundAnswer found;
  const std::size_t data_bytes = 2U * block.count;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto rest = bytes.subspan(at);
    found.answer = std::max(found.answer, Answer::incomplete);
    if (rest.size() < kMbapSize) return found;
    const std::size_t length = load_be<std::uint16_t>(rest, 4);
    if (rest[2] != 0 || rest[3] != 0 || length < 2 || length > 254) {
      found.answer = Answer::damaged;  // no way to know where the next frame begins
      return found;
    }
    if (rest.size() < 6 + length) return found;
    at += 6 + length;
    if (load_be<std::uint16_t>(rest) != transaction) continue;
    const std::uint8_t function = rest[kMbapSize];
    if (rest[6] != unit) {
      found.answer = Answer::wrong_unit;
    } else if (function == (block.function | kExceptionBit) && length == 3) {
      found.answer = Answer::exception;
      found.exception = rest[kMbapSize + 1];
    } else if (function == block.function && length == 3 + data_bytes &&
               rest[kMbapSize + 1] == data_bytes) {
      found.answer = Answer::good;
      found.data = at - data_bytes;
    } else {
      found.answer = Answer::damaged;
    }
    return found;
  }
  return found;
}

}  // namespace drover::link
