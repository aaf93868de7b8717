// For tests/mission/ordinary: how long the robot of a played scenario moved while its true error
// was beyond the bound that it published.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "mission/bound.h"
#include "mission/record.h"

namespace {

/// As it was played. Places are told by the arm that the gateway was told, wherever the antenna is.
nlohmann::json played(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "scenario.json");
  auto scenario = nlohmann::json::parse(stream);
  const auto told = scenario.value("/gateway/estimate"_json_pointer, nlohmann::json::object());
  for (const char* axis : {"x_m", "y_m"}) {
    const auto arm = told.find(std::string("antenna_") + axis);
    if (arm != told.end()) scenario["gnss"]["antenna"][axis] = *arm;
  }
  return scenario;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: ordinary_bound FOLDER\n", stderr);
    return 2;
  }
  try {
    const auto record = drover::mission::read_record(argv[1], played(argv[1]));
    const auto stood = drover::mission::stood_in_task(record);
    std::printf("stood %.1f s in %d pauses, ", stood.for_s, stood.times);
    const auto beyond = drover::mission::beyond_bound(record);
    std::printf("outside %.1f s", beyond.moved_s);
    if (beyond.moved_s > 0) std::printf(" (by %.0f mm)", 1e3 * beyond.worst_m);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
