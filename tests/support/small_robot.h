// A small robot with one of everything, as a configuration's text: two drives, receiver, sensor,
// battery and lines. Depends on nothing, so that fuzz targets may use it, too.
#pragma once

namespace drover::test {

inline constexpr auto kSmallRobot = R"({
  "links": {
    "can0": {"can": "can0"},
    "gnss": {"serial": "/dev/drover/gnss", "baud": 115200},
    "imu": {"serial": "/dev/drover/imu", "baud": 115200},
    "bms": {"modbus": "/dev/drover/battery", "baud": 9600},
    "panel": {"gpio": "chip0"}},
  "devices": {
    "left": {"driver": "odrive", "link": "can0", "options": {"node": 1},
             "accept": ["no_watchdog"]},
    "right": {"driver": "odrive", "link": "can0", "options": {"node": 2},
              "accept": ["no_watchdog"]},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "imu": {"driver": "witmotion", "link": "imu"},
    "battery": {"driver": "modbus_bms", "link": "bms", "map": "daly_d2.json",
                "options": {"max_voltage_V": 60}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"},
    "bumper": {"driver": "gpio_line", "link": "panel", "line": "b", "is": "bumper"}},
  "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
                      "left": ["left"], "right": ["right"], "hold": "brake"}},
  "limits": {"max_speed_mps": 0.8, "acceleration_mps2": 0.4},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

}  // namespace drover::test
