#include "integration/robot_rig.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "config/json_text.h"
#include "config/located_json.h"

namespace drover::test {

namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

milliseconds deadline() {
  const char* factor = ::getenv("DROVER_DEADLINE_FACTOR");
  return milliseconds(20'000) * (factor != nullptr ? std::max(1, std::atoi(factor)) : 1);
}

fs::path new_folder() {
  auto name = (fs::temp_directory_path() / "drover-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

/// A port of the loopback that nobody listens at now.
int free_port() {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(fd, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(fd);
  return ::ntohs(address.sin_port);
}

constexpr const char* kSimFile = R"({
  "name": "integration", "world": "@world@",
  "start": {"x_m": 0, "y_m": 0, "yaw_deg": 0},
  "origin": {"latitude_deg": 23.1496524965, "longitude_deg": 113.0196366456667, "altitude_m": 20},
  "can": {"can0": {"kind": "unix"}},
  "drives": [
    {"joint": "front_left", "driver": "odrive", "bus": "can0", "options": {"node": 1}},
    {"joint": "rear_left", "driver": "odrive", "bus": "can0", "options": {"node": 2}},
    {"joint": "front_right", "driver": "odrive", "bus": "can0", "options": {"node": 3}},
    {"joint": "rear_right", "driver": "odrive", "bus": "can0", "options": {"node": 4}}],
  "gnss": {"driver": "nmea0183", "antenna": {"x_m": 0.1, "y_m": 0, "z_m": 0.6}},
  "lines": {}
})";

// Ages and limits are wider than a robot's: a busy build machine is late without being broken.
constexpr const char* kDroverFile = R"({
  "robot": "integration",
  "paths": {"state": "@folder@/state", "run": "@folder@/run"},
  "control": {"realtime": false},
  "buses": [{"name": "can0", "interface": "unix:@folder@/sim/can0.sock"}],
  "drives": [
    {"joint": "front_left", "driver": "odrive", "bus": "can0",
     "options": {"node": 1, "stale_s": 1}},
    {"joint": "rear_left", "driver": "odrive", "bus": "can0",
     "options": {"node": 2, "stale_s": 1}},
    {"joint": "front_right", "driver": "odrive", "bus": "can0",
     "options": {"node": 3, "stale_s": 1}},
    {"joint": "rear_right", "driver": "odrive", "bus": "can0",
     "options": {"node": 4, "stale_s": 1}}],
  "base": {"wheel_radius_m": 0.165, "track_m": 0.6, "yaw_slip_factor": 1.69,
           "left": ["front_left", "rear_left"], "right": ["front_right", "rear_right"]},
  "gnss": {"port": "@folder@/sim/gnss", "options": {"stale_s": 2}},
  "lines": {"chip": "files:@folder@/sim/lines",
            "estop": {"line": "estop", "options": {"stale_s": 0.5}},
            "bumper": {"line": "bumper", "options": {"stale_s": 0.5}},
            "zone_far": {"line": "zone_far", "options": {"stale_s": 0.5}},
            "zone_near": {"line": "zone_near", "options": {"stale_s": 0.5}}},
  "estimate": {"antenna_x_m": 0.1, "antenna_z_m": 0.6},
  "health": {"drive_stale_s": 1, "gnss_stale_s": 2, "line_stale_s": 0.5},
  "guard": {"socket": "@folder@/guard.sock", "limit_ms": 500},
  "mqtt": {"port": @port@, "client_id": "droverd"}
})";

std::string filled(std::string text, std::string_view mark, const std::string& value) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
    text.replace(at, mark.size(), value);
  return text;
}

}  // namespace

RobotRig::RobotRig() : folder_(new_folder()), port_(free_port()) {
  // A report ends the program with a status of its own, wherever it was found.
  ::setenv("ASAN_OPTIONS", "exitcode=99:detect_leaks=1:strict_string_checks=1", 0);
  ::setenv("UBSAN_OPTIONS", "print_stacktrace=1", 0);
  ::setenv("TSAN_OPTIONS",
           "exitcode=99:suppressions=" DROVER_SOURCE_DIR "/tests/sanitize/thread.supp", 0);
  ::setenv("LSAN_OPTIONS", "suppressions=" DROVER_SOURCE_DIR "/tests/sanitize/leak.supp", 0);
  fs::create_directories(folder_ / "run");
  write_files();
}

RobotRig::~RobotRig() {
  if (daemon_.running()) stop_daemon();
  if (sim_.running()) {
    sim_.signal(SIGTERM);
    EXPECT_EQ(sim_.wait(deadline()), 0) << sim_.output();
  }
  for (const auto* process : {&daemon_, &sim_, &guard_}) expect_no_sanitizer_report(*process);
  if (HasFailure()) {
    for (const char* name : {"droverd.log", "guard.log", "sim.log", "broker.log"})
      std::fprintf(stderr, "---- %s\n%s\n", name, [&] {
        std::string text((std::istreambuf_iterator<char>(
                             *std::make_unique<std::ifstream>(folder_ / name))),
                         {});
        return text;
      }().c_str());
    for (const auto& heard : client_.heard())
      if (heard.topic == "feedback") std::fprintf(stderr, "feedback %s\n", heard.text.c_str());
    std::fprintf(stderr, "last base_status: %s\n", client_.last("base_status").c_str());
  }
  // Destructors of the processes run later: end them before their folder goes.
  for (auto* process : {&daemon_, &guard_, &sim_, &broker_}) {
    process->signal(SIGKILL);
    (void)process->wait(deadline());
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void RobotRig::write_files() {
  const auto folder = folder_.string();
  std::ofstream(folder_ / "sim.json")
      << filled(kSimFile, "@world@", DROVER_SOURCE_DIR "/sim/worlds/field.xml");
  std::ofstream(folder_ / "drover.json")
      << filled(filled(kDroverFile, "@folder@", folder), "@port@", std::to_string(port_));
  std::ofstream(folder_ / "mosquitto.conf")
      << "listener " << port_ << " 127.0.0.1\nallow_anonymous true\npersistence false\n";
}

void RobotRig::expect_no_sanitizer_report(const Process& process) const {
  const auto text = process.output();
  for (const char* word : {"AddressSanitizer", "LeakSanitizer", "ThreadSanitizer",
                           "runtime error:", "terminate called"})
    EXPECT_EQ(text.find(word), std::string::npos) << text;
}

void RobotRig::start_broker() {
  broker_ = Process({DROVER_MOSQUITTO, "-c", log("mosquitto.conf")}, log("broker.log"));
  ASSERT_TRUE(wait_until([this] { return client_.connect(port_); })) << broker_.output();
}

void RobotRig::start_sim() {
  sim_ = Process({DROVER_SIM_PROGRAM, "--scenario", log("sim.json"), "--run-dir", log("sim"),
                  "--log-dir", log("log"), "--can-transport", "unix", "--lines", "files"},
                 log("sim.log"));
  ASSERT_TRUE(wait_until([this] { return fs::exists(folder_ / "sim" / "ready"); }))
      << sim_.output();
}

void RobotRig::start_guard() {
  guard_ = Process({DROVER_GUARD_PROGRAM, "--socket", log("guard.sock")}, log("guard.log"));
  ASSERT_TRUE(wait_until([this] { return fs::exists(folder_ / "guard.sock"); }))
      << guard_.output();
}

void RobotRig::start_daemon() {
  daemon_ = Process({DROVERD_PROGRAM, "-c", log("drover.json")}, log("droverd.log"));
}

void RobotRig::start_all() {
  ASSERT_NO_FATAL_FAILURE(start_broker());
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon();
  ASSERT_TRUE(wait_for_locate());
}

void RobotRig::stop_daemon() {
  daemon_.signal(SIGTERM);
  EXPECT_EQ(daemon_.wait(deadline()), 0) << daemon_.output();
}

bool RobotRig::wait_until(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + deadline();
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    const auto before = client_.heard().size();
    client_.turn(milliseconds(20));
    if (client_.heard().size() == before) ::usleep(5000);  // no broker: do not spin
  }
  return true;
}

bool RobotRig::wait_for_feedback(std::string_view cmd, std::size_t from) {
  return wait_until([&] {
    const auto all = client_.feedback(from);
    return std::find(all.begin(), all.end(), cmd) != all.end();
  });
}

bool RobotRig::wait_for_status(std::string_view nav_status) {
  return wait_until([&] { return status_text("nav", "status") == nav_status; });
}

bool RobotRig::wait_for_locate() {
  return wait_until([&] { return status_text("nav", "locate") == "LOCATE_TRUE"; });
}

void RobotRig::control(std::string_view text, bool retained) {
  client_.publish("mqtt_control", text, retained);
}

void RobotRig::save_track(const std::string& name, double length_m) {
  constexpr double kMetresPerDegree = 111'320;
  const double x_m = status_number("pose", "x");
  const double y_m = status_number("pose", "y");
  const double latitude_deg = status_number("rtk", "latitude");
  const double longitude_deg = status_number("rtk", "longitude");
  json::JsonText text;
  text.open('{').key("cmd_type").text("trajectory_control").key("cmd").text("save_trajectory");
  text.key("data").open('{').key("name").text(name).key("data").open('[');
  for (double s_m = 0; s_m < length_m + 0.01; s_m += 0.5) {
    text.open('{').key("angle").number(90).key("latitude").number(latitude_deg);
    text.key("longitude")
        .number(longitude_deg +
                s_m / kMetresPerDegree / std::cos(latitude_deg * std::acos(-1.0) / 180));
    text.key("x").number(x_m + s_m).key("y").number(y_m).key("yaw").number(0).close('}');
  }
  text.close(']').close('}').close('}');
  const auto before = client_.heard().size();
  control(text.str());
  ASSERT_TRUE(wait_for_feedback("save_trajectory_success", before));
}

void RobotRig::start_task(const std::string& name, int id, double speed_mps) {
  json::JsonText text;
  text.open('{').key("cmd_type").text("task_control").key("cmd").text("start_task");
  text.key("name").text(name).key("id").integer(id).key("speed").number(speed_mps).close('}');
  control(text.str());
}

void RobotRig::drive(double length_m) {
  ASSERT_NO_FATAL_FAILURE(save_track("row", length_m));
  const auto before = client_.heard().size();
  start_task("row", static_cast<int>(length_m / 0.5) + 1);
  ASSERT_TRUE(wait_for_feedback("start_nav_success", before));
  ASSERT_TRUE(wait_until([&] { return true_speed_mps() > 0.1; }));
}

CommandResult RobotRig::run(const std::vector<std::string>& words) {
  const auto file = log(("command" + std::to_string(++commands_) + ".log").c_str());
  Process process(words, file);
  const auto code = process.wait(deadline());
  return {code.value_or(-1), process.output()};
}

CommandResult RobotRig::drover(std::vector<std::string> words) {
  words.insert(words.begin(), {DROVER_PROGRAM, "--socket", log("run/drover.sock")});
  return run(words);
}

CommandResult RobotRig::droverd(std::vector<std::string> words) {
  words.insert(words.begin(), DROVERD_PROGRAM);
  return run(words);
}

std::string RobotRig::sim(std::vector<std::string> words) {
  words.insert(words.begin(), {DROVER_SIM_PROGRAM, "ctl", "--run-dir", log("sim")});
  return run(words).text;
}

std::string RobotRig::status_text(std::string_view section, std::string_view key) const {
  const auto document = json::parse(client_.last("base_status"));
  const auto* part = document ? document->root.find(section) : nullptr;
  const auto* value = part != nullptr ? part->find(key) : nullptr;
  if (value == nullptr) return {};
  if (const auto* text = value->text()) return *text;
  if (const auto* flag = value->boolean()) return *flag ? "true" : "false";
  return {};
}

double RobotRig::status_number(std::string_view section, std::string_view key) const {
  const auto document = json::parse(client_.last("base_status"));
  const auto* part = document ? document->root.find(section) : nullptr;
  const auto* value = part != nullptr ? part->find(key) : nullptr;
  const auto number = value != nullptr ? value->number() : std::nullopt;
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

double RobotRig::true_speed_mps() {
  const auto truth = json::parse(sim({"truth"}));
  const auto* vx = truth ? truth->root.find("vx_mps") : nullptr;
  EXPECT_NE(vx, nullptr) << sim_.output();
  return vx != nullptr ? std::abs(vx->number().value_or(99)) : 99;
}

std::vector<SetPoint> RobotRig::set_points_on_the_bus() {
  sim_.signal(SIGTERM);
  EXPECT_EQ(sim_.wait(deadline()), 0) << sim_.output();
  constexpr unsigned kSetInputVel = 0x0D;  // ODrive CANSimple: node in bits 5 to 10, command below
  std::vector<SetPoint> points;
  std::ifstream file(folder_ / "log" / "can.log");
  std::string line;
  while (std::getline(file, line)) {
    SetPoint point;
    unsigned id = 0;
    unsigned b[4]{};
    if (std::sscanf(line.c_str(), "(%lf) can0 %3x#%2x%2x%2x%2x", &point.time_s, &id, &b[0], &b[1],
                    &b[2], &b[3]) != 6 ||
        (id & 0x1FU) != kSetInputVel)
      continue;
    const std::uint32_t bits = b[0] | b[1] << 8U | b[2] << 16U | b[3] << 24U;
    std::memcpy(&point.velocity_turnps, &bits, sizeof bits);
    point.node = id >> 5U;
    points.push_back(point);
  }
  return points;
}

double RobotRig::now_s() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace drover::test
