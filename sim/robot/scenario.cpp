#include "sim/robot/scenario.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "config/register_map.h"
#include "sim/robot/device_reader.h"
#include "sim/robot/scenario_file.h"

namespace drover::sim {
namespace {

CanKind read_kind(JsonReader& reader) {
  const auto kind = reader.text("kind");
  if (kind == "vcan") return CanKind::vcan;
  if (kind == "canfd") return CanKind::canfd;
  if (kind == "slcan") return CanKind::slcan;
  if (kind == "unix") return CanKind::unix_socket;
  reader.fail("kind", "must be one of vcan, canfd, slcan, unix");
}

void read_buses(JsonReader& top, Scenario& scenario) {
  if (!top.has("can")) return;
  auto can = top.object("can");
  for (const auto& name : can.keys()) {
    if (name.empty() || name.size() > 15 || name.find_first_of("/ .") != std::string::npos)
      can.fail(name, "is no name of an interface");
    auto bus = can.object(name);
    scenario.buses.push_back({name, read_kind(bus)});
    bus.done();
  }
}

GnssSpec read_gnss(JsonReader reader) {
  GnssSpec gnss;
  gnss.driver = &find_twin<MakeGnssTwin>(reader, reader.text("driver", "nmea0183"));
  gnss.port = reader.text("port", gnss.port);
  gnss.baud = read_baud(reader, gnss.baud);
  if (reader.has("antenna")) {
    auto antenna = reader.object("antenna");
    gnss.antenna_x_m = antenna.number("x_m", 0);
    gnss.antenna_y_m = antenna.number("y_m", 0);
    gnss.antenna_z_m = antenna.number("z_m", 0);
    gnss.heading_offset_deg = antenna.number("heading_offset_deg", 0);
    antenna.done();
  }
  read_options(reader, *gnss.driver, gnss.options);
  reader.done();
  return gnss;
}

/// `scenario` has its buses.
ImuSpec read_imu(JsonReader reader, const Scenario& scenario) {
  ImuSpec imu;
  const auto driver = reader.text("driver", "witmotion");
  imu.driver = &find_twin<MakeImuTwin, MakeCanImuTwin>(reader, driver);
  const bool on_can = std::holds_alternative<MakeCanImuTwin>(imu.driver->make_twin);
  for (const auto* key : {"bus", "port", "baud"})
    if (reader.has(key) && (std::string_view(key) == "bus") != on_can)
      reader.fail(key, "'" + driver + "' hangs on " + (on_can ? "a CAN bus" : "a serial line"));
  if (on_can) {
    imu.bus = read_bus(reader, scenario);
  } else {
    imu.port = reader.text("port", imu.port);
    imu.baud = read_baud(reader, imu.baud);
  }
  if (reader.has("place")) {
    auto place = reader.object("place");
    imu.x_m = place.number("x_m", 0);
    imu.y_m = place.number("y_m", 0);
    imu.z_m = place.number("z_m", 0);
    place.done();
  }
  read_options(reader, *imu.driver, imu.options);
  if (!on_can) imu.options.set("baud", static_cast<double>(imu.baud));
  reader.done();
  return imu;
}

BatterySpec read_battery(JsonReader reader, const std::string& folder) {
  BatterySpec battery;
  battery.driver = &find_twin<MakeRegisterTwin>(reader, reader.text("driver", "modbus_bms"));
  const auto map = reader.text("map");
  if (const auto missing = config::missing_register_map(map, folder); !missing.message.empty())
    reader.fail("map", missing.text());
  const auto file = config::find_register_map(map, folder);
  auto loaded = config::load_register_map(file);
  for (const auto& problem : loaded.problems) reader.fail("map", problem.text(file));
  battery.map = std::move(loaded.map);
  battery.port = reader.text("port", battery.port);
  battery.baud = static_cast<int>(reader.number("baud", battery.map.baud));
  battery.unit = static_cast<std::uint8_t>(reader.number("unit", battery.map.unit));
  battery.model.capacity_Ah = reader.number("capacity_Ah", battery.model.capacity_Ah);
  battery.model.soc_percent = reader.number("soc_percent", battery.model.soc_percent);
  battery.model.idle_W = reader.number("idle_W", battery.model.idle_W);
  battery.model.charger_A = reader.number("charger_A", battery.model.charger_A);
  if (!(battery.model.capacity_Ah > 0)) reader.fail("capacity_Ah", "must be above 0");
  if (!(battery.model.soc_percent >= 0 && battery.model.soc_percent <= 100))
    reader.fail("soc_percent", "must be from 0 to 100");
  read_options(reader, *battery.driver, battery.options);
  battery.model.cells = battery.options.number("cells");
  reader.done();
  return battery;
}

ScannerSpec read_lidar(JsonReader reader) {
  ScannerSpec lidar;
  lidar.driver = &find_twin<MakeScannerTwin>(reader, reader.text("driver", "ld06"));
  lidar.port = reader.text("port", lidar.port);
  const auto& bauds = lidar.driver->bauds;
  lidar.baud = read_baud(reader, bauds.empty() ? lidar.baud : bauds[0]);
  if (reader.has("place")) {
    auto place = reader.object("place");
    lidar.x_m = place.number("x_m", 0);
    lidar.y_m = place.number("y_m", 0);
    lidar.z_m = place.number("z_m", 0);
    lidar.yaw_deg = place.number("yaw_deg", 0);
    place.done();
  }
  lidar.reach_m = reader.number("reach_m", lidar.reach_m);
  if (!(lidar.reach_m > 0 && lidar.reach_m <= 1000))
    reader.fail("reach_m", "must be above 0, and 1000 at most");
  // Where it is says "place": what the gateway has to be told of it is not asked for here again.
  std::vector<OptionSpec> specs(lidar.driver->options.begin(), lidar.driver->options.end());
  for (auto& spec : specs) spec.required = false;
  reader.options("options", specs, lidar.options);
  reader.options("twin", lidar.driver->twin_options, lidar.options);
  reader.done();
  return lidar;
}

/// "more": {"gnss_rear": {"is": "gnss", ...}}, with the keys that the first of the kind has.
void read_more(JsonReader& top, const std::string& folder, Scenario& scenario) {
  if (!top.has("more")) return;
  auto more = top.object("more");
  for (const auto& name : more.keys()) {
    auto reader = more.object(name);
    const auto is = reader.text("is");
    MoreSpec spec;
    spec.name = name;
    if (name == "gnss" || name == "imu" || name == "battery")
      more.fail(name, "is the name of the first of its kind");
    if (is == "gnss") {
      spec.gnss = read_gnss(reader);
    } else if (is == "imu") {
      spec.imu = read_imu(reader, scenario);
    } else if (is == "battery") {
      spec.battery = read_battery(reader, folder);
    } else {
      reader.fail("is", "must be gnss, imu or battery");
    }
    scenario.more.push_back(std::move(spec));
  }
  more.done();
}

void read_lines(JsonReader& top, Scenario& scenario) {
  if (!top.has("lines")) return;
  auto lines = top.object("lines");
  for (std::size_t i = 0; i < kLineNames; ++i) {
    const auto active = lines.text(kLineText[i], "low");
    if (active != "low" && active != "high" && active != "unwired")
      lines.fail(kLineText[i], "must be the active level, low or high, or unwired");
    scenario.lines[i] = {active != "unwired", active == "high"};
  }
  lines.done();
}

void read_zones(JsonReader& top, Scenario& scenario) {
  if (!top.has("zones")) return;
  auto zones = top.object("zones");
  scenario.zone_near_m = zones.number("near_m", scenario.zone_near_m);
  scenario.zone_far_m = zones.number("far_m", scenario.zone_far_m);
  scenario.zone_width_m = zones.number("width_m", scenario.zone_width_m);
  if (!(scenario.zone_near_m > 0)) zones.fail("near_m", "must be above 0");
  if (!(scenario.zone_far_m >= scenario.zone_near_m))
    zones.fail("far_m", "must not be below near_m");
  if (!(scenario.zone_width_m > 0)) zones.fail("width_m", "must be above 0");
  zones.done();
}

void read_places(JsonReader& top, Scenario& scenario) {
  if (top.has("start")) {
    auto start = top.object("start");
    scenario.start_x_m = start.number("x_m", 0);
    scenario.start_y_m = start.number("y_m", 0);
    scenario.start_yaw_deg = start.number("yaw_deg", 0);
    start.done();
  }
  auto origin = top.object("origin");
  scenario.origin_latitude_deg = origin.number("latitude_deg");
  scenario.origin_longitude_deg = origin.number("longitude_deg");
  scenario.origin_altitude_m = origin.number("altitude_m", 0);
  if (!(std::abs(scenario.origin_latitude_deg) <= 89))
    origin.fail("latitude_deg", "must be from -89 to 89");
  if (!(std::abs(scenario.origin_longitude_deg) <= 180))
    origin.fail("longitude_deg", "must be from -180 to 180");
  origin.done();
}

void read_truth_rate(JsonReader& top, Scenario& scenario) {
  const double rate_Hz = top.number("truth_Hz", 20);
  if (!(rate_Hz >= 1 && rate_Hz <= 200)) top.fail("truth_Hz", "must be from 1 to 200");
  scenario.truth_period = from_s(1 / rate_Hz);
}

void read_events(JsonReader& top, Scenario& scenario) {
  if (!top.has("events")) return;
  for (auto& item : top.list("events")) {
    const double at_s = item.number("at_s");
    if (!(at_s >= 0 && at_s <= 1e6)) item.fail("at_s", "must be from 0 to 1000000");
    scenario.events.push_back({from_s(at_s), item.text("command")});
    item.done();
  }
  std::stable_sort(scenario.events.begin(), scenario.events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
}

Scenario read_scenario(const nlohmann::json& document, const std::string& folder) {
  JsonReader top(document, "");
  Scenario scenario;
  scenario.name = top.text("name", "");
  scenario.world = (std::filesystem::path(folder) / top.text("world")).lexically_normal();
  read_places(top, scenario);
  read_buses(top, scenario);
  if (top.has("drives"))
    for (auto& drive : top.list("drives")) scenario.drives.push_back(read_drive(drive, scenario));
  if (top.has("gnss")) scenario.gnss = read_gnss(top.object("gnss"));
  if (top.has("imu")) scenario.imu = read_imu(top.object("imu"), scenario);
  if (top.has("battery")) scenario.battery = read_battery(top.object("battery"), folder);
  if (top.has("lidar")) scenario.lidar = read_lidar(top.object("lidar"));
  read_more(top, folder, scenario);
  read_lines(top, scenario);
  read_zones(top, scenario);
  scenario.outputs = top.flag("outputs", false);
  scenario.estop_cuts_power = top.flag("estop_cuts_power", false);
  scenario.relay_feeds_drives = top.flag("relay_feeds_drives", false);
  scenario.brake = top.flag("brake", false);
  scenario.worm_gear = top.flag("worm_gear", false);
  read_truth_rate(top, scenario);
  read_events(top, scenario);
  for (const auto* key : {"description", "gateway", "mission", "player"}) top.ignore(key);
  top.done();
  return scenario;
}

}  // namespace

bool DriveSpec::is_called(std::string_view text) const {
  return (!name.empty() && name == text) ||
         std::find(joints.begin(), joints.end(), text) != joints.end();
}

Scenario parse_scenario(std::string_view json, const std::string& folder) {
  return read_scenario(parse_json(json), folder);
}

Scenario load_scenario(const std::string& file) {
  const auto document = load_scenario_document(file);
  try {
    return read_scenario(document, std::filesystem::path(file).parent_path().string());
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace drover::sim
