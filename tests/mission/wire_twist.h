// What is told to a base that takes a twist, read by hand: GT01 on its serial line and on CAN, and
// AgileX protocol v2. It shares nothing with the drivers on purpose.
//
// Sources: GT01 serial and CAN protocol (drivers/gt01/README.md names them); AgileX ugv_sdk,
// protocol v2.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drover/can_frame.h"
#include "drover/time.h"

namespace drover::mission {

/// What one message asks of the base.
struct TwistCommand {
  double vx_mps = 0;
  double wz_radps = 0;
  bool moves() const { return !(vx_mps == 0 && wz_radps == 0); }
};

namespace gt01 {

/// What one packet on its serial line asks for.
struct Asked {
  Time time = kNever;  ///< when its last byte was there
  std::uint16_t sequence = 0;
  TwistCommand twist;
  bool moves() const { return twist.moves(); }
};

struct Line {
  std::vector<Asked> packets;
  std::size_t strange = 0;  ///< bytes that belong to no twist
};

/// A record's serial.log: "(12.345678901) base EDDE...", one line a tick, packets cut anywhere.
Line read_line(const std::filesystem::path& folder);

std::optional<TwistCommand> twist_command(const CanFrame& frame);
/// Empty when the frame is one that the chassis sends, or a twist; otherwise what is wrong with it.
std::string forbidden(const CanFrame& frame);

}  // namespace gt01

namespace agilex_v2 {

std::optional<TwistCommand> twist_command(const CanFrame& frame);
/// As above; a chassis, and an inertial sensor in J1939's frames on its bus.
std::string forbidden(const CanFrame& frame);

}  // namespace agilex_v2

namespace hunter {

std::optional<TwistCommand> twist_command(const CanFrame& frame);
/// Of the inner wheel, left positive.
std::optional<double> steering_rad(const CanFrame& frame);
/// As above.
std::string forbidden(const CanFrame& frame);

}  // namespace hunter

}  // namespace drover::mission
