// Finds the speed at which a WitMotion sensor talks and brings its settings to what is wanted.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/witmotion/codec.h"
#include "drover/driver.h"
#include "drover/options.h"

namespace drover::witmotion {

/// Register values.
struct Settings {
  std::uint16_t content = 0;
  std::uint16_t rate = 0;
  std::uint16_t baud = 0;
  std::uint16_t bandwidth = 0;
  std::uint16_t algorithm = 0;
};

/// 9600, 10 Hz, acceleration, rate, angles and field, nine axes.
inline constexpr Settings kFactory{0x001E, 6, 2, 0, 0};
/// What the driver's options ask for. Throws std::runtime_error when the device has no such
/// settings, or the line's speed is too low for them.
Settings wanted_settings(const Options& options);

/// What the driver sees of the device.
struct Observed {
  Time last_byte = kNever;
  Time last_frame = kNever;
  std::uint16_t content = 0;  ///< Content bits of the latest output cycle
  double pace_Hz = kAbsent;   ///< of output cycles
};

/// The output's pace may differ from what is set by this factor.
inline constexpr double kPaceTolerance = 1.5;

/// Listens; asks the device for its registers; writes those that differ, with the maker's pauses;
/// asks again and saves only what the device has taken. Flash is therefore written when a setting
/// was wrong, and never at an ordinary start. Begins anew when the link or the device comes back,
/// or when what arrives is no longer what is wanted. Sends nothing but unlock, save, reads and the
/// five settings above.
class Setup final {
 public:
  /// `enabled` false: it never sends and never changes the line's speed.
  Setup(const Settings& wanted, std::uint32_t baud, bool enabled);

  void on_link_up(Time now);
  void on_frame() { ++frames_; }
  void on_registers(const Registers& registers, Time now);
  void on_tick(Time now, const Observed& seen, DriverOut& out);

  /// The speed at which the line is open now.
  std::uint32_t line_baud() const { return line_baud_; }
  /// The device does not keep what was written to it.
  bool refused() const { return refused_; }

 private:
  enum class Step : std::uint8_t { listen, ask, decide, write, watch };
  struct Write {
    Register address = Register::save;
    std::uint16_t value = 0;
  };

  void go(Step step, Time now);
  void begin_anew(Time now);
  void listen(Time now, const Observed& seen, DriverOut& out);
  void ask(Time now, DriverOut& out);
  void decide(Time now, const Observed& seen);
  void find_differences(const Observed& seen);
  void plan(Register address, std::uint16_t value) { (void)writes_.push_back({address, value}); }
  void write(Time now, DriverOut& out);
  void watch(Time now, const Observed& seen);
  bool falls_short(const Observed& seen) const;
  void reopen(std::uint32_t baud, Time now, DriverOut& out);
  void send(const Command& command, DriverOut& out);

  Settings wanted_;
  std::uint32_t home_baud_;
  bool enabled_;

  Step step_ = Step::listen;
  Time since_ = kNever;  ///< of this step; of the latest try in it
  std::uint32_t line_baud_;
  bool expecting_link_ = false;
  std::size_t candidate_ = 0;
  std::uint32_t frames_ = 0;  ///< heard since the step began

  Settings found_;
  bool readable_ = true;  ///< the device answers reads
  std::size_t block_ = 0;
  int tries_ = 0;
  bool asked_ = false;
  Time quiet_until_ = kNever;

  FixedVector<Write, 8> writes_;
  std::size_t next_write_ = 0;
  Time next_write_at_ = kNever;
  bool unlock_next_ = false;
  bool unsaved_ = false;
  bool refused_ = false;
  int rounds_ = 0;
  int saves_ = 0;

  Time short_since_ = kNever;
  bool doubted_ = false;  ///< asked because too little came
  Time no_check_before_ = kNever;
};

}  // namespace drover::witmotion
