// Any bytes as a recording: no crash, and every recording that is refused says why. The first byte
// chooses: the rest is a whole file, or the records of a small robot's.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "config/load.h"
#include "gateway/recording/encoder.h"
#include "gateway/replay.h"

namespace {

using namespace drover;
using namespace drover::gateway;

void require(bool holds) {
  if (!holds) std::abort();
}

constexpr auto kRobot = R"({
  "buses": [{"name": "can0", "interface": "can0"}],
  "drives": [
    {"joint": "left", "driver": "odrive", "bus": "can0", "options": {"node": 1},
     "accept": ["no_watchdog"]},
    {"joint": "right", "driver": "odrive", "bus": "can0", "options": {"node": 2},
     "accept": ["no_watchdog"]}],
  "base": {"wheel_radius_m": 0.165, "track_m": 0.6, "left": ["left"], "right": ["right"],
           "hold": "brake"},
  "gnss": {"port": "/dev/drover/gnss", "baud": 115200},
  "imu": {"driver": "witmotion", "port": "/dev/drover/imu", "baud": 115200},
  "battery": {"map": "daly_d2.json", "port": "/dev/drover/battery", "baud": 9600,
              "options": {"max_voltage_V": 60}},
  "lines": {"chip": "chip0", "estop": {"line": "a"}, "bumper": {"line": "b"}},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

std::vector<std::uint8_t> header() {
  const auto loaded = config::load_text(kRobot, std::string(DROVER_SOURCE_DIR) + "/config/maps");
  require(loaded.problems.empty());
  const Gateway gateway(loaded.config);
  return written(RecordingHeader{"fuzz", loaded.text, loaded.register_map,
                                 mathematics_fingerprint(), field_names(gateway)});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 8192) return 0;
  static const auto kHeader = header();
  std::vector<std::uint8_t> file;
  if (data[0] % 8 != 0) file = kHeader;
  file.insert(file.end(), data + 1, data + size);
  const auto it = replay(file);
  if (it.verdict == Replayed::Verdict::unusable) require(!it.note.empty());
  if (it.verdict == Replayed::Verdict::differs) require(!it.difference.what.empty());
  return 0;
}
