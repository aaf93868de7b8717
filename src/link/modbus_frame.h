// Modbus frames as bytes: read requests, and the search for their answers in whatever came in.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drover/driver.h"
#include "drover/fixed_vector.h"

namespace drover::link {

inline constexpr std::size_t kRtuRequestSize = 8;
inline constexpr std::size_t kTcpRequestSize = 12;
using ModbusBytes = FixedVector<std::uint8_t, 512>;

std::array<std::uint8_t, kRtuRequestSize> rtu_read_request(std::uint8_t unit,
                                                           const RegisterBlock& block);
/// MODBUS Messaging on TCP/IP V1.0b, 3.1.3.
std::array<std::uint8_t, kTcpRequestSize> tcp_read_request(std::uint16_t transaction,
                                                           std::uint8_t unit,
                                                           const RegisterBlock& block);

enum class Answer : std::uint8_t {
  nothing,     ///< no byte but our own echo
  incomplete,  ///< bytes, but no whole answer (yet)
  damaged,     ///< a whole answer with a wrong checksum, or of another length
  wrong_unit,  ///< somebody else's good answer
  exception,
  good,
};

struct FoundAnswer {
  Answer answer = Answer::nothing;
  std::uint8_t exception = 0;
  std::size_t data = 0;    ///< good: where the registers begin
  std::size_t echoes = 0;  ///< our own request, heard back
};

/// What everything that came in since the request amounts to. An echo of the request is skipped, so
/// is noise before the answer: an answer is what has unit, function, the length asked for and a
/// good checksum. 40 bits must fit, so noise is none.
FoundAnswer find_rtu_answer(std::span<const std::uint8_t> bytes, std::uint8_t unit,
                            const RegisterBlock& block);

/// The same on TCP: frames of other transactions are late answers and are skipped.
FoundAnswer find_tcp_answer(std::span<const std::uint8_t> bytes, std::uint16_t transaction,
                            std::uint8_t unit, const RegisterBlock& block);

}  // namespace drover::link
