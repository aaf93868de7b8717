#include "sim/robot/device_reader.h"

#include <algorithm>

namespace drover::sim {

const DriverEntry& find_twin(const JsonReader& reader, const std::string& name, IsTwin fits) {
  std::string known;
  for (const auto& entry : driver_registry()) {
    if (!fits(entry)) continue;
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  reader.fail("driver", "no simulated '" + name +
                            "' of this kind; there is: " + (known.empty() ? "none" : known));
}

void read_options(JsonReader& reader, const DriverEntry& entry, Options& options) {
  reader.options("options", entry.options, options);
  reader.options("twin", entry.twin_options, options);
}

int read_baud(JsonReader& reader, int otherwise) {
  const double baud = reader.number("baud", otherwise);
  if (!(baud >= 4800 && baud <= 4'000'000)) reader.fail("baud", "must be from 4800 to 4000000");
  return static_cast<int>(baud);
}

std::size_t read_bus(JsonReader& reader, const Scenario& scenario) {
  const auto bus = reader.text("bus");
  const auto at = std::find_if(scenario.buses.begin(), scenario.buses.end(),
                               [&bus](const BusSpec& spec) { return spec.name == bus; });
  if (at == scenario.buses.end()) reader.fail("bus", "'" + bus + "' is not in 'can'");
  return static_cast<std::size_t>(at - scenario.buses.begin());
}

}  // namespace drover::sim
