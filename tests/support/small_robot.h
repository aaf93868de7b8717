// A small robot with one of everything, as a configuration's text: two drives, receiver, sensor,
// battery and lines. Depends on nothing, so that fuzz targets may use it, too.
#pragma once

namespace drover::test {

inline constexpr auto kSmallRobot = R"({
  "buses": [{"name": "can0", "interface": "can0"}],
  "drives": [
    {"joint": "left", "driver": "odrive", "bus": "can0", "options": {"node": 1},
     "accept": ["no_watchdog"]},
    {"joint": "right", "driver": "odrive", "bus": "can0", "options": {"node": 2},
     "accept": ["no_watchdog"]}],
  "base": {"wheel_radius_m": 0.165, "track_m": 0.6, "left": ["left"], "right": ["right"],
           "hold": "brake"},
  "limits": {"max_speed_mps": 0.8, "acceleration_mps2": 0.4},
  "gnss": {"port": "/dev/drover/gnss", "baud": 115200},
  "imu": {"driver": "witmotion", "port": "/dev/drover/imu", "baud": 115200},
  "battery": {"map": "daly_d2.json", "port": "/dev/drover/battery", "baud": 9600,
              "options": {"max_voltage_V": 60}},
  "lines": {"chip": "chip0", "estop": {"line": "a"}, "bumper": {"line": "b"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

}  // namespace drover::test
