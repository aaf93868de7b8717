// The whole robot in one thread: a simulated one in MuJoCo and the gateway of its configuration,
// what one of them says carried to the other at the next tick. No clock, no descriptor.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/load.h"
#include "gateway/gateway.h"
#include "sim/robot/robot.h"
#include "support/allocation_counter.h"
#include "support/simulated_robots.h"
#include "unit/gateway/recorded_run.h"

namespace drover::test {

using namespace std::chrono_literals;

class WholeRobot {
 public:
  explicit WholeRobot(const std::string& name)
      : loaded(config::load_file(robot_file(name, ".drover.json"))),
        gateway(loaded.config),
        robot(on_free_ground(name), sim::make_twins(on_free_ground(name), 1)),
        path(straight_m(4)) {
    const auto& lines = gateway.wiring().links;
    bauds_.resize(lines.size());
    for (std::size_t link = 0; link < lines.size(); ++link)
      bauds_[link] = loaded.config.links[lines[link].place].baud;
  }
  /// From now on everything is recorded.
  void record(gateway::PlantedRecording& recording) { recording_ = &recording; }

  void cycle() {
    now += sim::kTick;
    if (now == kBegin) begin();
    hand_over();
    robot.step(now);
    hear_buses();
    hear_lines();
    hear_levels();
    hear_batteries();
    if (loaded.config.engine.clearance_required) see_nothing_near();
    apply(gateway::Tick{true, false, false});
    if (recording_ != nullptr) recording_->output(gateway);
  }
  void run_s(double time_s) {
    for (const Time end = now + from_s(time_s); now < end;) cycle();
  }
  void command(const decltype(Command::body)& body) {
    apply(gateway::CommandGiven{{{RequestId::Source::mqtt, ++requests_}, now, body}});
  }
  /// To the end of `path` at 0.5 m/s; asked for again and again until it is taken.
  void start_task() {
    command(SetOrigin{{robot.scenario().origin_latitude_deg, robot.scenario().origin_longitude_deg,
                       robot.scenario().origin_altitude_m}});
    for (int i = 0; i < 30 && seen().nav.status != NavStatus::run; ++i) {
      if (recording_ != nullptr) recording_->path(path);  // a refusal gave it back
      command(StartTask{&path, static_cast<std::uint32_t>(path.points.size() - 1), 0.5});
      run_s(1);
    }
  }
  /// Until it ends, or for so long.
  void drive_s(double most_s) {
    for (const Time end = now + from_s(most_s); now < end && seen().nav.status == NavStatus::run;)
      cycle();
  }

  const Snapshot& seen() const { return gateway.snapshot(); }
  std::string why() const {
    std::string all;
    for (const Reason& reason : seen().why) all += std::string(reason.view()) + "; ";
    return all;
  }

  config::Loaded loaded;
  gateway::Gateway gateway;
  sim::Robot robot;
  Path path;  ///< four metres ahead
  Time now = kBegin - sim::kTick;
  std::uint64_t allocations = 0;  ///< of the gateway

 private:
  static constexpr Time kBegin{100s};

  /// Before it nothing stands in the way, whichever world it is in.
  static sim::Scenario on_free_ground(const std::string& name) {
    sim::Scenario scenario = sim::load_scenario(robot_file(name, ".json"));
    const bool in_the_hall = scenario.world.find("hall") != std::string::npos;
    scenario.start_x_m = in_the_hall ? -3.5 : -10;
    scenario.start_y_m = in_the_hall ? 1 : -2;
    return scenario;
  }
  Path straight_m(double length_m) const {
    Path straight;
    straight.number = 1;
    straight.name = "row";
    for (double x_m = 0; x_m < length_m + 0.01; x_m += 0.5)
      straight.points.push_back({robot.scenario().start_x_m + x_m, robot.scenario().start_y_m});
    return straight;
  }

  void apply(const gateway::InputBody& body) {
    const gateway::Input input{now, body};
    if (recording_ != nullptr) recording_->input(input);
    const AllocationCounter counter;
    gateway.apply(input);
    allocations += counter.count();
  }
  const config::LinkConfig& configured(gateway::LinkId link) const {
    return loaded.config.links[gateway.wiring().links[link].place];
  }
  /// As the simulator calls its end of the line.
  std::string port(gateway::LinkId link) const {
    return std::filesystem::path(address(configured(link))).filename();
  }
  template <class Each>
  void each_link(Wire wire, const Each& each) {
    for (std::size_t link = 0; link < gateway.wiring().links.size(); ++link)
      if (gateway.wiring().links[link].wire == wire) each(static_cast<gateway::LinkId>(link));
  }

  void begin() {
    for (std::size_t link = 0; link < gateway.wiring().links.size(); ++link)
      apply(gateway::LinkUp{static_cast<gateway::LinkId>(link)});
    apply(gateway::OutputsUp{false});
  }
  /// What the last cycle said, to the devices.
  void hand_over() {
    const auto& said = gateway.output();
    each_link(Wire::can, [&](gateway::LinkId link) {
      for (const CanFrame& frame : said.frames[link]) robot.on_frame(bus(link), frame, now);
    });
    for (const auto& stream : said.streams) {
      if (stream.link == gateway::kNowhere) continue;
      if (stream.reopen_baud != 0) bauds_[stream.link] = static_cast<int>(stream.reopen_baud);
      write(port(stream.link), stream.bytes);
    }
    robot.set_relay(said.engine.outputs[static_cast<std::size_t>(Output::enable_relay)]);
  }
  std::size_t bus(gateway::LinkId link) const {
    const auto& buses = robot.scenario().buses;
    for (std::size_t i = 0; i < buses.size(); ++i)
      if (buses[i].name == configured(link).can) return i;
    throw std::logic_error("the simulated robot has no bus " + configured(link).can);
  }
  void write(const std::string& to, std::span<const std::uint8_t> bytes) {
    const sim::Scenario& scenario = robot.scenario();
    for (std::size_t i = 0; i < scenario.drives.size(); ++i)
      if (scenario.drives[i].serial && scenario.drives[i].serial->port == to)
        robot.on_drive_bytes(i, bytes, now);
    if (scenario.imu && !scenario.imu->bus && scenario.imu->port == to)
      robot.on_imu_bytes(bytes, now);
    for (std::size_t i = 0; i < scenario.more.size(); ++i)
      if (scenario.more[i].imu && scenario.more[i].imu->port == to)
        robot.more().on_bytes(i, bytes, now);
  }

  void hear_buses() {
    each_link(Wire::can, [&](gateway::LinkId link) {
      for (const CanFrame& frame : robot.frames(bus(link))) apply(gateway::FrameHeard{link, frame});
    });
  }
  void hear_lines() {
    each_link(Wire::bytes, [&](gateway::LinkId link) {
      const std::string from = port(link);
      const sim::Scenario& scenario = robot.scenario();
      for (std::size_t i = 0; i < scenario.drives.size(); ++i)
        if (scenario.drives[i].serial && scenario.drives[i].serial->port == from)
          hear(link, robot.drive_bytes(i), 0);
      if (scenario.gnss && scenario.gnss->port == from) hear(link, robot.gnss_bytes(), 0);
      if (scenario.imu && !scenario.imu->bus && scenario.imu->port == from)
        hear(link, robot.imu_bytes(), robot.imu_baud());
      for (std::size_t i = 0; i < scenario.more.size(); ++i) {
        const sim::MoreSpec& more = scenario.more[i];
        if ((more.gnss && more.gnss->port == from) || (more.imu && more.imu->port == from))
          hear(link, robot.more().bytes(i), robot.more().baud(i));
      }
    });
  }
  /// Nothing is understood of who speaks at another speed.
  void hear(gateway::LinkId link, std::string_view bytes, int baud) {
    if (bytes.empty() || (baud != 0 && baud != bauds_[link])) return;
    apply(gateway::BytesHeard{link,
                              {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  }
  void hear_levels() {
    each_link(Wire::levels, [&](gateway::LinkId link) {
      gateway::LevelsRead read;
      read.link = link;
      for (const gateway::SlotId slot : gateway.wiring().links[link].slots) {
        const std::string& line = device(slot).line;
        for (std::size_t i = 0; i < sim::kLineNames; ++i)
          if (line == sim::kLineText[i] || line == std::to_string(i))
            (void)read.levels.push_back(robot.line_high(static_cast<sim::LineName>(i)));
      }
      apply(read);
    });
  }
  const config::DeviceConfig& device(gateway::SlotId slot) const {
    return loaded.config.devices[gateway.wiring().slots[slot].place];
  }
  void hear_batteries() {
    if ((now - kBegin) % 1s != 0s) return;
    each_link(Wire::registers, [&](gateway::LinkId link) {
      for (const gateway::SlotId slot : gateway.wiring().links[link].slots) read(slot);
    });
  }
  void read(gateway::SlotId slot) {
    const RegisterTwin* twin = registers(device(slot).unit);
    ASSERT_NE(twin, nullptr) << device(slot).name;
    const auto blocks = gateway.wiring().slots[slot].made.registers->blocks();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      gateway::RegistersRead answer{slot, static_cast<std::uint8_t>(i), {}};
      answer.words.resize(blocks[i].count);
      ASSERT_TRUE(twin->read(blocks[i].function, blocks[i].address,
                             {answer.words.data(), answer.words.size()}));
      apply(answer);
    }
  }
  const RegisterTwin* registers(int unit) {
    const sim::Scenario& scenario = robot.scenario();
    for (std::size_t i = 0; i < scenario.more.size(); ++i)
      if (scenario.more[i].battery && scenario.more[i].battery->unit == unit)
        return robot.more().registers(i);
    return robot.battery_registers();
  }
  void see_nothing_near() {
    const Viewpoint& view = gateway.viewpoint();
    if (view.t == kNever) return;
    Clearance found;
    found.t = view.t;
    found.path = view.way.path;
    found.twist = view.asked;
    found.along_m = found.ahead_m = found.back_m = 50;
    found.left_rad = found.right_rad = 7;
    found.bare = {50, 50, 50, 7, 7};
    apply(gateway::ClearanceFound{found});
  }

  std::vector<int> bauds_;  ///< by link
  gateway::PlantedRecording* recording_ = nullptr;
  std::uint64_t requests_ = 0;
};

}  // namespace drover::test
