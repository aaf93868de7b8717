// One SDO transfer after another with one node: a question, its answer, or why there is none.
// Source: CiA 301, section 7.2.4.
#pragma once

#include <optional>

#include "drivers/canopen/sdo.h"
#include "drover/time.h"

namespace drover::canopen {

/// How a transfer ended.
struct SdoOutcome {
  enum class Kind : std::uint8_t { written, read, refused, silent };
  Kind kind = Kind::written;
  Object object;
  FixedVector<std::uint8_t, 64> data;  ///< read: as the node sent it, lowest byte first
  std::uint32_t code = 0;              ///< refused: the abort code, the node's or our own

  /// Of what was read: 1 to 4 bytes as an unsigned number; absent for longer values.
  std::optional<std::uint32_t> number() const;
};

/// A server answers one request at a time, so the client asks one at a time. Answers to other
/// objects, late ones and those after an abort are left alone. A value that is longer than 64 bytes
/// is given up with "out of memory", a node that sends nothing for `patience` with "no answer in
/// time".
class SdoClient {
 public:
  explicit SdoClient(std::uint8_t node, Duration patience = std::chrono::milliseconds(200))
      : node_(node), patience_(patience) {}

  bool busy() const { return state_ != State::idle; }
  /// The frame to send. Only while not busy.
  CanFrame read(Object object, Time now);
  CanFrame write(Object object, SdoNumber value, Time now);

  /// Of any frame: the frame to send next, if there is one.
  std::optional<CanFrame> on_frame(const CanFrame& frame, Time now);
  /// Gives up a transfer that waits too long: the abort to send.
  std::optional<CanFrame> on_tick(Time now);
  /// The node was restarted, or the bus was away: what waits is forgotten.
  void forget();

  /// Once for each transfer that ended.
  std::optional<SdoOutcome> take_outcome();

 private:
  enum class State : std::uint8_t { idle, reading, writing, segments };
  void begin(State state, Object object, Time now);
  void end(SdoOutcome::Kind kind, std::uint32_t code = 0);
  std::optional<CanFrame> give_up(std::uint32_t code);
  std::optional<CanFrame> on_segment(const SdoAnswer& segment, Time now);
  bool keep(const SdoAnswer& answer);

  std::uint8_t node_;
  Duration patience_;
  State state_ = State::idle;
  Time since_ = kNever;
  bool toggle_ = false;
  std::optional<std::uint32_t> announced_;
  SdoOutcome current_;
  std::optional<SdoOutcome> outcome_;
};

}  // namespace drover::canopen
