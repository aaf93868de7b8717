// What all devices of a robot file are read with.
#pragma once

#include <string>
#include <string_view>

#include "drover/registry.h"
#include "sim/robot/json_reader.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

/// The driver of this name whose simulated device one of the factories `MakeTwin` makes. Refuses
/// the key "driver" otherwise, and says which there are.
using IsTwin = bool (*)(const DriverEntry&);
const DriverEntry& find_twin(const JsonReader& reader, const std::string& name, IsTwin fits);
template <class... MakeTwin>
const DriverEntry& find_twin(const JsonReader& reader, const std::string& name) {
  return find_twin(reader, name, [](const DriverEntry& entry) {
    return (std::holds_alternative<MakeTwin>(entry.make_twin) || ...);
  });
}

/// "options" and "twin".
void read_options(JsonReader& reader, const DriverEntry& entry, Options& options);
int read_baud(JsonReader& reader, int otherwise);

/// "bus": index into the scenario's.
std::size_t read_bus(JsonReader& reader, const Scenario& scenario);

/// One of "drives". `scenario` has its buses and the drives before this one.
DriveSpec read_drive(JsonReader& reader, const Scenario& scenario);

}  // namespace drover::sim
