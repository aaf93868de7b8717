// A robot for benchmarks: the gateway of many drives, and the frames that they send.
#pragma once

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "config/load.h"
#include "drover/bytes.h"
#include "gateway/gateway.h"

namespace drover::gateway {

inline constexpr Duration kTick = std::chrono::milliseconds(5);
inline constexpr std::uint8_t kRunning = 8;  // ODrive's closed loop

/// So many are on each of eight buses at the most; few are four to a bus.
inline std::size_t drives_per_bus(std::size_t drives) {
  return std::max<std::size_t>(4, (drives + kMaxBuses - 1) / kMaxBuses);
}

/// A skid-steer robot of `drives` motors. Joints outside the base are refused, so that a robot of
/// many joints is one of many wheels here: all that a joint costs it costs as a wheel, and the
/// kinematics and the watch over wheels beside.
/// `folder`: where the buses are sockets; empty: they have names only.
inline std::string configuration(std::size_t drives, const std::string& folder = {}) {
  std::string buses;
  std::string axes;
  std::string left;
  std::string right;
  const auto add = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  const std::size_t per_bus = drives_per_bus(drives);
  for (std::size_t i = 0; i < drives; ++i) {
    const auto bus = "can" + std::to_string(i / per_bus);
    const auto joint = "wheel" + std::to_string(i);
    if (i % per_bus == 0)
      add(buses, R"(")" + bus + R"(": {"can": ")" +
                     (folder.empty() ? bus : "unix:" + folder + "/" + bus) + R"("})");
    add(axes, R"(")" + joint + R"(": {"driver": "odrive", "link": ")" + bus +
                  R"(", "options": {"node": )" + std::to_string(i % per_bus + 1) +
                  R"(}, "accept": ["no_watchdog"]})");
    add(i % 2 == 0 ? left : right, '"' + joint + '"');
  }
  return R"({"links": {)" + buses + R"(, "gnss": {"serial": "/dev/drover/gnss"}}, "devices": {)" +
         axes + R"(, "gnss": {"driver": "nmea0183", "link": "gnss"}},
         "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
                             "hold": "brake", "left": [)" +
         left + R"(], "right": [)" + right + R"(]}}, "accept": ["no_estop"],
         "guard": {"socket": ")" +
         (folder.empty() ? "/run/drover" : folder) +
         R"(/guard.sock"}, "mqtt": {"host": "127.0.0.1", "port": 1883}})";
}

inline config::DroverConfig robot(std::size_t drives) {
  auto loaded = config::load_text(configuration(drives));
  for (const auto& problem : loaded.problems) throw std::runtime_error(problem.text("robot"));
  return loaded.config;
}

/// The gateway and the frames that its drives send.
class Robot {
 public:
  explicit Robot(std::size_t drives)
      : gateway_(robot(drives)), drives_(drives), per_bus_(drives_per_bus(drives)) {
    for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus)
      gateway_.apply({now_, LinkUp{static_cast<LinkId>(bus)}});
    for (int i = 0; i < 400; ++i) cycle();
  }
  void hear_heartbeat(std::size_t drive) {
    hear(drive, make_frame(id(drive, 1), {0, 0, 0, 0, kRunning, 0, 0, 0}));
  }
  void hear_encoder(std::size_t drive) { hear(drive, encoder(drive)); }
  CanFrame encoder(std::size_t drive) {
    turned_ += 1e-4F;
    CanFrame frame = make_frame(id(drive, 9), {0, 0, 0, 0, 0, 0, 0, 0});
    store_le(frame.data, 0, std::bit_cast<std::uint32_t>(turned_));
    return frame;
  }
  void hear(std::size_t drive, const CanFrame& frame) {
    gateway_.apply({now_, FrameHeard{static_cast<std::uint8_t>(drive / per_bus_), frame}});
  }
  void tick() {
    now_ += kTick;
    gateway_.apply({now_, Tick{true, false, false}});
  }
  void cycle() {
    for (std::size_t i = 0; i < drives_; ++i) {
      hear_heartbeat(i);
      hear_encoder(i);
    }
    tick();
  }
  Gateway& gateway() { return gateway_; }
  Time now() const { return now_; }

 private:
  std::uint32_t id(std::size_t drive, std::uint32_t command) const {
    return static_cast<std::uint32_t>(drive % per_bus_ + 1) << 5U | command;
  }
  Gateway gateway_;
  std::size_t drives_;
  std::size_t per_bus_;
  Time now_{std::chrono::seconds(100)};
  float turned_ = 0;
};

}  // namespace drover::gateway
