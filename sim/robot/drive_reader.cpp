// A drive of the robot file: which joints it turns, and on which wire it hangs.
#include <algorithm>
#include <set>

#include "sim/robot/device_reader.h"

namespace drover::sim {
namespace {

/// "joint" of a drive of one, "joints" of any.
void read_joints(JsonReader& reader, const Scenario& scenario, DriveSpec& drive) {
  const bool one = reader.has("joint");
  if (one == reader.has("joints")) reader.fail("joints", "say either 'joint' or 'joints'");
  const auto* const key = one ? "joint" : "joints";
  if (one) {
    drive.joints = {reader.text("joint")};
  } else {
    drive.joints = reader.texts("joints");
  }
  drive.name = reader.text("name", "");
  std::set<std::string> seen;
  for (const auto& joint : drive.joints) {
    if (!seen.insert(joint).second) reader.fail(key, "'" + joint + "' stands there twice");
    for (const auto& other : scenario.drives)
      if (other.is_called(joint)) reader.fail(key, "'" + joint + "' has a drive already");
  }
  for (const auto& other : scenario.drives)
    if (!drive.name.empty() && other.is_called(drive.name))
      reader.fail("name", "'" + drive.name + "' is another drive's");
}

std::size_t shafts_of(const DriverEntry& driver) {
  return driver.twin_shafts != 0 ? driver.twin_shafts : driver.channels.size();
}

SerialSpec read_serial(JsonReader reader, const Scenario& scenario) {
  SerialSpec serial;
  serial.port = reader.text("port", serial.port);
  serial.baud = read_baud(reader, serial.baud);
  for (const auto& other : scenario.drives)
    if (other.serial && other.serial->port == serial.port)
      reader.fail("port", "'" + serial.port + "' has a drive already");
  reader.done();
  return serial;
}

}  // namespace

DriveSpec read_drive(JsonReader& reader, const Scenario& scenario) {
  DriveSpec drive;
  read_joints(reader, scenario, drive);
  const auto driver = reader.text("driver");
  drive.driver = &find_twin<MakeCanTwin, MakeByteDriveTwin>(reader, driver);
  const std::size_t shafts = shafts_of(*drive.driver);
  if (drive.joints.size() != shafts)
    reader.fail("joints", "'" + driver + "' turns " + std::to_string(shafts) + ", here are " +
                              std::to_string(drive.joints.size()));
  const bool on_can = std::holds_alternative<MakeCanTwin>(drive.driver->make_twin);
  if (reader.has(on_can ? "serial" : "bus"))
    reader.fail(on_can ? "serial" : "bus",
                "'" + driver + "' hangs on " + (on_can ? "a CAN bus" : "a serial line"));
  if (on_can)
    drive.bus = read_bus(reader, scenario);
  else
    drive.serial = read_serial(reader.object("serial"), scenario);
  drive.own_supply = reader.flag("own_supply", false);
  read_options(reader, *drive.driver, drive.options);
  reader.done();
  return drive;
}

}  // namespace drover::sim
