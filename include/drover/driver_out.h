// What a driver says in answer to one call.
#pragma once

#include <cstdint>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/message.h"

namespace drover {

/// The caller owns it and empties it.
struct DriverOut {
  FixedVector<Measurement, 64> measurements;
  FixedVector<CanFrame, 32> frames;  ///< on a CAN bus: to be sent, in this order
  /// On a byte stream, from what moves something: to be written, each whole or not at all.
  FixedVector<Packet, 8> packets;
  /// On a byte stream, from what moves nothing: to be written, in this order.
  FixedVector<std::uint8_t, 512> bytes;
  /// On a byte stream: not 0: close the line and open it again at this speed, once `bytes` have
  /// left.
  std::uint32_t reopen_baud = 0;
  std::uint32_t overflows = 0;  ///< things that did not fit and were dropped

  /// Made where it stays: most values are far smaller than a Measurement.
  template <class Value>
  void report(Time time, Time received, const Value& value) {
    const auto make = [&] { return Measurement{time, received, value}; };
    overflows += measurements.push_made(make) ? 0 : 1;
  }
  void report(const Measurement& m) { overflows += measurements.push_back(m) ? 0 : 1; }
  void send(const CanFrame& f) { overflows += frames.push_back(f) ? 0 : 1; }
  void send(const Packet& p) { overflows += packets.push_back(p) ? 0 : 1; }
  void clear() {
    measurements.clear();
    frames.clear();
    packets.clear();
    bytes.clear();
    reopen_baud = 0;
    overflows = 0;
  }
};

}  // namespace drover
