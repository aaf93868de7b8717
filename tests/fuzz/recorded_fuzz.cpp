// Any bytes as a recording that `drover gnss|imu|bms|can --file` shows: no crash, every line of
// --json is JSON, and nothing that moves a terminal's cursor.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "cli/recorded.h"
#include "json/located_json.h"

namespace {

using namespace drover;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_text(const std::string& text) {
  for (const char c : text)
    require(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F));
}

void check_json(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) require(json::parse(line).ok());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 2048) return 0;
  // The first byte chooses the device and how it is shown.
  constexpr std::string_view kDevices[] = {"gnss", "imu", "bms", "can"};
  constexpr std::string_view kDrivers[] = {"nmea0183", "witmotion", "modbus_bms", "odrive"};
  const std::size_t device = data[0] % 4;
  cli::Recording recording;
  recording.driver = kDrivers[device];
  recording.json = (data[0] & 4U) != 0;
  if (device == 2) recording.map = DROVER_SOURCE_DIR "/config/maps/daly_d2.json";
  if (device == 3) {
    if ((data[0] & 8U) != 0) {
      recording.driver.clear();
    } else {
      recording.nodes = {1, 3};
    }
  }
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  std::ostringstream out;
  std::ostringstream notes;
  const int code = cli::show_recording(kDevices[device], in, recording, out, notes);
  require(code == 1 || (code == 0 && !out.str().empty()));
  check_text(notes.str());
  check_text(out.str());
  if (recording.json) check_json(out.str());
  return 0;
}
