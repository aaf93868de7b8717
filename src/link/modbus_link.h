// A line or connection to Modbus devices, one request at a time, each inside its own deadline.
//
// libmodbus opens and closes it. Requests and answers are framed here, because what libmodbus 3.1.6
// does with them must not reach a value: each byte of an answer starts its byte time-out anew, so
// that one call may take minutes; a late answer is believed, whatever it was to; raw requests over
// TCP all have transaction 0; the unit of an answer over TCP is not looked at.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drover/driver.h"
#include "drover/time.h"
#include "link/modbus_frame.h"
#include "link/opened.h"

struct _modbus;  // libmodbus' own name  NOLINT(bugprone-reserved-identifier)

namespace drover::link {

/// Below src/runtime nobody reads a clock: it is given.
using NowFunction = Time (*)();

struct ModbusSettings {
  std::string port;  ///< serial line, or "tcp:ADDRESS:PORT"
  int baud = 9600;
  char parity = 'N';  ///< 'N', 'E', 'O'
};

/// One of the devices on it.
struct ModbusUnit {
  std::uint8_t address = 1;
  double gap_s = 0.1;    ///< silence on the line before a request
  double reply_s = 0.5;  ///< longest wait for a whole answer, at most 1 s
};

struct ModbusCounters {
  std::uint64_t requests = 0;
  std::uint64_t answers = 0;
  std::uint64_t late_bytes = 0;  ///< came when nothing was asked; thrown away
  std::uint64_t echoes = 0;
};

/// What became of a request.
struct ModbusResult {
  bool good = false;
  RegisterFailure failure = RegisterFailure::silent;
  int exception = 0;  ///< of RegisterFailure::refused
};

class ModbusLink final {
 public:
  struct Closer {
    void operator()(_modbus* context) const;
  };
  using Context = std::unique_ptr<_modbus, Closer>;

  ModbusLink(Context context, const ModbusSettings& settings, NowFunction now);

  /// Asks the unit and waits for the whole answer, at most `reply_s`. After RegisterFailure::link
  /// the line is gone: close it. `words` has the block's count.
  ModbusResult read(const ModbusUnit& unit, const RegisterBlock& block,
                    std::span<std::uint16_t> words);
  /// The next request to this unit may leave then: after the gap, and after a request that it left
  /// without an answer only when no late one can come any more. That pause doubles with each such
  /// request in a row, from 1 s to 4 s, and begins anew with each late byte. Other units need not
  /// wait for it: a late answer has its sender's address.
  Time ready_at(const ModbusUnit& unit) const;
  /// To be called when the descriptor is readable and nothing is asked: late bytes and noise are
  /// thrown away. False: the line is gone.
  bool drain();

  int fd() const { return fd_; }
  const ModbusCounters& counters() const { return counters_; }
  /// errno of what made the line go; 0: nothing.
  int error() const { return error_; }

 private:
  bool send(std::span<const std::uint8_t> bytes);
  /// Appends what is there; false: the line is gone.
  bool receive();
  /// Sends the request; false: the line is gone.
  bool ask(const ModbusUnit& unit, const RegisterBlock& block);
  /// What came until `deadline`; nothing: the line is gone.
  std::optional<FoundAnswer> await(const ModbusUnit& unit, const RegisterBlock& block, Time now,
                                   Time deadline);
  /// When who may be asked again.
  void note_spoken(const ModbusUnit& unit, bool answered);
  ModbusResult finish(const FoundAnswer& found, std::span<std::uint16_t> words);
  FoundAnswer look(const ModbusUnit& unit, const RegisterBlock& block) const;
  /// Late answers to requests that were given up.
  struct Owed {
    int unanswered = 0;  ///< requests in a row
    Time until = kNever;
  };

  Context context_;
  NowFunction now_;
  int fd_;
  bool tcp_;
  std::uint16_t transaction_ = 0;
  int unanswered_ = 0;            ///< requests in a row, whoever was asked
  Time used_ = kNever;            ///< when somebody spoke last
  std::array<Owed, 256> owed_{};  ///< by address
  ModbusBytes bytes_;
  ModbusCounters counters_;
  int error_ = 0;
};

/// Takes at most a second. The serial line is locked against other programs.
Opened<ModbusLink> open_modbus(const ModbusSettings& settings, NowFunction now);

}  // namespace drover::link
