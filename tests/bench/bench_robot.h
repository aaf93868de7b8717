// A robot for benchmarks: the gateway of many drives, and the frames that they send.
#pragma once

#include <bit>
#include <stdexcept>
#include <string>

#include "config/load.h"
#include "drover/bytes.h"
#include "gateway/gateway.h"

namespace drover::gateway {

inline constexpr Duration kTick = std::chrono::milliseconds(5);
inline constexpr std::uint8_t kRunning = 8;  // ODrive's closed loop

/// A skid-steer robot of `drives` motors, four to a bus.
inline std::string configuration(std::size_t drives) {
  std::string buses;
  std::string axes;
  std::string left;
  std::string right;
  const auto add = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  for (std::size_t i = 0; i < drives; ++i) {
    const auto bus = "can" + std::to_string(i / 4);
    const auto joint = "wheel" + std::to_string(i);
    if (i % 4 == 0) add(buses, R"(")" + bus + R"(": {"can": ")" + bus + R"("})");
    add(axes, R"(")" + joint + R"(": {"driver": "odrive", "link": ")" + bus +
                  R"(", "options": {"node": )" + std::to_string(i + 1) +
                  R"(}, "accept": ["no_watchdog"]})");
    add(i % 2 == 0 ? left : right, '"' + joint + '"');
  }
  return R"({"links": {)" + buses + R"(, "gnss": {"serial": "/dev/drover/gnss"}}, "devices": {)" +
         axes + R"(, "gnss": {"driver": "nmea0183", "link": "gnss"}},
         "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
                             "hold": "brake", "left": [)" +
         left + R"(], "right": [)" + right + R"(]}}, "accept": ["no_estop"],
         "mqtt": {"host": "127.0.0.1", "port": 1883}})";
}

inline config::DroverConfig robot(std::size_t drives) {
  auto loaded = config::load_text(configuration(drives));
  for (const auto& problem : loaded.problems) throw std::runtime_error(problem.text("robot"));
  return loaded.config;
}

/// The gateway and the frames that its drives send.
class Robot {
 public:
  explicit Robot(std::size_t drives) : gateway_(robot(drives)), drives_(drives) {
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
    gateway_.apply({now_, FrameHeard{static_cast<std::uint8_t>(drive / 4), frame}});
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
  static std::uint32_t id(std::size_t drive, std::uint32_t command) {
    return static_cast<std::uint32_t>(drive + 1) << 5U | command;
  }
  Gateway gateway_;
  std::size_t drives_;
  Time now_{std::chrono::seconds(100)};
  float turned_ = 0;
};

}  // namespace drover::gateway
