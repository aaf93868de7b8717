// The CAN buses: which drives do not go together on one.
#include <algorithm>
#include <cstdio>

#include "config/check_subjects.h"
#include "text/number.h"

namespace drover::config {
namespace {

/// Drivers whose frames mean harm to each other's devices.
struct Enemies {
  std::string_view one;
  std::string_view other;
  std::string_view with;  ///< the other, in words
  std::string_view why;
  double master_id = -1;  ///< only when the one answers under this id
};
constexpr Enemies kEnemies[] = {
    {"damiao", "odrive", "an odrive",
     "what reads its registers (0x7FF) is by its id an ODrive's broadcast to enter firmware "
     "update"},
    {"damiao", "zlac8015d", "a zlac8015d when it answers under the master id 0",
     "its answers are by their id commands that start and reset CANopen nodes", 0},
    {"damiao", "cia402", "a cia402 when it answers under the master id 0",
     "its answers are by their id commands that start and reset CANopen nodes", 0},
    {"cubemars_mit", "zlac8015d", "a zlac8015d",
     "its answers under the master id 0 are by their id commands that start and reset CANopen "
     "nodes",
     0},
};

/// Of what nobody wrote the default is no answer: a damiao's stands for another id.
bool means_harm(const Enemies& enemies, const DeviceConfig& device, const Findings& found) {
  if (device.driver != enemies.one) return false;
  return enemies.master_id < 0 || (found.given(device_path(device, "options.master_id")) &&
                                   device.options.number("master_id") == enemies.master_id);
}

void company_on_a_bus(Findings& found) {
  const auto& devices = found.config().devices;
  for (const auto& enemies : kEnemies)
    for (const auto& device : devices)
      if (means_harm(enemies, device, found) &&
          std::any_of(devices.begin(), devices.end(), [&](const auto& each) {
            return each.driver == enemies.other && each.link == device.link;
          }))
        found.add(device_path(device, "link"),
                  "a " + std::string(enemies.one) + " shares no bus with " +
                      std::string(enemies.with) + ": " + std::string(enemies.why),
                  "a bus of its own");
}

/// A motor that nobody gave an id to answer under does it under 0.
void as_it_is_delivered(Findings& found) {
  const auto& devices = found.config().devices;
  for (const auto& device : devices) {
    if (device.driver != "damiao" || found.has_problem(device_path(device, "link"))) continue;
    const auto path = device_path(device, "options.master_id");
    if (found.given(path) && device.options.number("master_id") == 0 && !found.is_wrong(path))
      found.hint_at(path,
                    "is 0, which means 16 more than id: a motor that answers under 0, as it may be "
                    "delivered, is not heard",
                    "give the motor an id to answer under (its register 7), and write that, or "
                    "leave this out");
    const auto drive = std::find_if(devices.begin(), devices.end(), [&](const auto& each) {
      return each.link == device.link && (each.driver == "cia402" || each.driver == "zlac8015d");
    });
    if (drive == devices.end()) continue;
    return found.warn(device_path(device, "link"),
                      "shares \"" + device.link + "\" with " + device_path(*drive) + " (" +
                          drive->driver +
                          "): a motor that answers under 0, as it may be delivered, sends by this "
                          "id commands that start and reset CANopen nodes; and 1 Mbit/s, as the "
                          "motor is delivered, has to be the drive's speed, too",
                      "mixed_bus", "a bus of its own");
  }
}

/// Of two motors of one bus: the id under which the first one would hear the second, were it set to
/// be told speeds. 0: there is none.
int speed_id_of(const DeviceConfig& motor, const DeviceConfig& controllers) {
  constexpr int kTold = 0x200;  // both: a motor's speed is told there, and a controller tells it
  constexpr int kMotors = 4;
  const int id = static_cast<int>(motor.options.number("id"));
  const int first = controllers.options.text("motors") == "1-4" ? 1 : 5;
  return id >= first && id < first + kMotors ? kTold + id : 0;
}

/// A motor that is not set to what the driver speaks hears more than its own id.
void told_by_others(Findings& found) {
  const auto& devices = found.config().devices;
  for (const auto& motor : devices) {
    if (motor.driver != "damiao" || found.has_problem(device_path(motor))) continue;
    for (const auto& other : devices) {
      if (other.driver != "robomaster_c620" || other.link != motor.link) continue;
      const int id = speed_id_of(motor, other);
      if (id == 0 || found.has_problem(device_path(other, "options"))) continue;
      char hex[8];
      (void)std::snprintf(hex, sizeof hex, "0x%03X", static_cast<unsigned>(id));
      found.warn(device_path(motor, "options.id"),
                 device_path(motor) + " (damiao) and " + device_path(other) +
                     " (robomaster_c620) share the id " + hex + " on \"" + motor.link +
                     "\": what a controller tells under it is a speed to a motor that is not in "
                     "MIT mode",
                 "mixed_bus", "a bus of its own, or another id for the motor");
    }
  }
}

/// What drives speak that cannot be set to another bit rate, or hardly anybody does.
struct BitRate {
  std::string_view driver;
  int kbps;
};
constexpr BitRate kBitRates[] = {{"damiao", 1000},          {"cubemars_mit", 1000},
                                 {"robomaster_c620", 1000}, {"agilex_v2", 500},
                                 {"agilex_hunter", 500},    {"gt01_can", 500}};

/// 0: it is set at the device.
int pace(const DeviceConfig& device) {
  for (const auto& each : kBitRates)
    if (each.driver == device.driver) return each.kbps;
  return 0;
}

std::string in_words(const DeviceConfig& device) {
  return std::to_string(pace(device)) + " kbit/s";
}

/// A bus has one bit rate: at another one a device breaks every frame.
void differ_in_pace(Findings& found) {
  const auto& devices = found.config().devices;
  for (const auto& device : devices) {
    if (pace(device) == 0) continue;
    const auto first = std::find_if(devices.begin(), devices.end(), [&](const auto& each) {
      return each.link == device.link && pace(each) != 0;
    });
    if (pace(*first) == pace(device) || found.has_problem(device_path(device, "link"))) continue;
    found.warn(device_path(device, "link"),
               device_path(device) + " (" + device.driver + ") speaks at " + in_words(device) +
                   ", and " + device_path(*first) + " (" + first->driver + ") on \"" + device.link +
                   "\" at " + in_words(*first) + ": a bus has one bit rate",
               "mixed_bus", "a bus of its own");
  }
}

}  // namespace

void check_buses(Findings& found) {
  company_on_a_bus(found);
  as_it_is_delivered(found);
  told_by_others(found);
  differ_in_pace(found);
}

}  // namespace drover::config
