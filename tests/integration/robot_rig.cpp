#include "integration/robot_rig.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "runtime/robot_memory.h"

namespace drover::test {

int deadline_factor() {
  const char* factor = ::getenv("DROVER_DEADLINE_FACTOR");
  return factor != nullptr ? std::max(1, std::atoi(factor)) : 1;
}

namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// In memory where there is such a place: a robot that logs to a busy disk stands still meanwhile.
fs::path new_folder() {
  const fs::path memory("/dev/shm");
  const bool there = ::access(memory.c_str(), W_OK) == 0;
  auto name = ((there ? memory : fs::temp_directory_path()) / "drover-XXXXXX").string();
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

/// The lines of the shipped broker file that say how much, not who.
std::string shipped_broker_limits() {
  std::ifstream file(DROVER_SOURCE_DIR "/config/mosquitto/drover.conf");
  std::string limits;
  for (std::string line; std::getline(file, line);)
    for (const char* word : {"max_", "memory_", "persist", "set_tcp_"})
      if (line.starts_with(word)) limits += line + "\n";
  return limits;
}

constexpr const char* kMaps = DROVER_SOURCE_DIR "/config/maps";

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
  "imu": {"driver": "witmotion", "place": {"x_m": 0.05, "z_m": 0.15},
          "options": {"mount_yaw_deg": -90}},
  "battery": {"map": "@maps@/daly_d2.json", "soc_percent": 84},
  "lines": {}
})";

// Ages and limits are wider than a robot's: a busy build machine is late without being broken.
constexpr const char* kDroverFile = R"({
  "robot": "integration",
  "paths": {"state": "@folder@/state", "run": "@folder@/run"},
  "control": {"realtime": false},
  "links": {
    "can0": {"can": "unix:@folder@/sim/can0.sock"},
    "gnss": {"serial": "@folder@/sim/gnss"},
    "imu": {"serial": "@folder@/sim/imu"},
    "bms": {"modbus": "@folder@/sim/battery"},
    "panel": {"gpio": "files:@folder@/sim/lines"}
  },
  "devices": {
    "front_left": {"driver": "odrive", "link": "can0", "accept": ["no_watchdog"],
      "options": {"node": 1, "stale_s": 1, "heartbeat_timeout_s": 1}},
    "rear_left": {"driver": "odrive", "link": "can0", "accept": ["no_watchdog"],
      "options": {"node": 2, "stale_s": 1, "heartbeat_timeout_s": 1}},
    "front_right": {"driver": "odrive", "link": "can0", "accept": ["no_watchdog"],
      "options": {"node": 3, "stale_s": 1, "heartbeat_timeout_s": 1}},
    "rear_right": {"driver": "odrive", "link": "can0", "accept": ["no_watchdog"],
      "options": {"node": 4, "stale_s": 1, "heartbeat_timeout_s": 1}},
    "gnss": {"driver": "nmea0183", "link": "gnss", "options": {"stale_s": 2}},
    "imu": {"driver": "witmotion", "link": "imu", "options": {"mount_yaw_deg": -90, "stale_s": 2}},
    "battery": {"driver": "modbus_bms", "link": "bms", "map": "@maps@/daly_d2.json",
      "period_s": 0.5, "options": {"stale_s": 5}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "estop", "is": "estop",
      "options": {"stale_s": 0.5}},
    "bumper": {"driver": "gpio_line", "link": "panel", "line": "bumper", "is": "bumper",
      "options": {"stale_s": 0.5}},
    "zone_far": {"driver": "gpio_line", "link": "panel", "line": "zone_far", "is": "zone_far",
      "options": {"stale_s": 0.5}},
    "zone_near": {"driver": "gpio_line", "link": "panel", "line": "zone_near", "is": "zone_near",
      "options": {"stale_s": 0.5}}
  },
  "groups": {
    "base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
      "yaw_slip_factor": 1.69, "hold": "brake",
      "left": ["front_left", "rear_left"], "right": ["front_right", "rear_right"]}
  },
  "estimate": {"antenna_x_m": 0.1, "antenna_z_m": 0.6,
               "wheel_stale_s": 0.5, "imu_stale_s": 0.5},
  "health": {"drive_stale_s": 1, "gnss_stale_s": 2, "imu_stale_s": 2, "line_stale_s": 0.5,
             "joint_command_timeout_s": 1},
  "guard": {"socket": "@folder@/run/guard.sock", "limit_ms": 500},
  "mqtt": {"port": @port@, "client_id": "droverd"}
})";

std::string filled(std::string text, std::string_view mark, const std::string& value) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

}  // namespace

milliseconds RobotRig::deadline() const {
  const auto left = began_ + std::chrono::seconds(500) - std::chrono::steady_clock::now();
  return std::clamp(std::chrono::duration_cast<milliseconds>(left), milliseconds(5000),
                    milliseconds(60'000) * deadline_factor());
}

RobotRig::RobotRig() : folder_(new_folder()), port_(free_port()) {
  // A report ends the program with a status of its own, wherever it was found.
  ::setenv("ASAN_OPTIONS", "exitcode=99:detect_leaks=1:strict_string_checks=1", 0);
  ::setenv("UBSAN_OPTIONS", "print_stacktrace=1", 0);
  // droverd ends without a thread that hangs, and leaves the others as they are: no leak.
  ::setenv("TSAN_OPTIONS",
           "exitcode=99:report_thread_leaks=0:suppressions=" DROVER_SOURCE_DIR
           "/tests/sanitize/thread.supp",
           0);
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
  bool clean = true;
  for (const auto* process : {&daemon_, &sim_, &guard_})
    clean = expect_no_sanitizer_report(*process) && clean;
  if (HasFailure()) tell_what_happened();
  if (HasFailure() && clean && starvation_.starved()) {
    machine_was_starved = true;
    std::fprintf(stderr, "a sleeping thread woke %.1f s too late\n", starvation_.longest_s());
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
  std::ofstream(folder_ / "sim.json") << filled(
      filled(kSimFile, "@world@", DROVER_SOURCE_DIR "/sim/worlds/field.xml"), "@maps@", kMaps);
  std::ofstream(folder_ / "drover.json")
      << filled(filled(filled(kDroverFile, "@folder@", folder), "@port@", std::to_string(port_)),
                "@maps@", kMaps);
  std::ofstream(folder_ / "mosquitto.conf")
      << "listener " << port_ << " 127.0.0.1\nallow_anonymous true\n"
      << shipped_broker_limits();
}

bool RobotRig::expect_no_sanitizer_report(const Process& process) const {
  const auto text = process.output();
  for (const char* word : {"AddressSanitizer", "LeakSanitizer", "ThreadSanitizer",
                           "runtime error:", "terminate called"}) {
    if (text.find(word) == std::string::npos) continue;
    ADD_FAILURE() << text;
    return false;
  }
  return true;
}

void RobotRig::tell_what_happened() const {
  for (const char* name : {"droverd.log", "guard.log", "sim.log", "broker.log"}) {
    std::ifstream file(folder_ / name);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    std::fprintf(stderr, "---- %s\n%s\n", name, text.c_str());
  }
  for (const auto& heard : client_.heard())
    if (heard.topic == "feedback") std::fprintf(stderr, "feedback %s\n", heard.text.c_str());
  std::fprintf(stderr, "the client %s\n", client_.connected() ? "is connected" : "is cut off");
  std::fprintf(stderr, "last base_status: %s\n", client_.last("base_status").c_str());
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
  guard_ = Process({DROVER_GUARD_PROGRAM, "--socket", log("run/guard.sock")}, log("guard.log"));
  ASSERT_TRUE(wait_until([this] { return fs::exists(folder_ / "run" / "guard.sock"); }))
      << guard_.output();
}

void RobotRig::start_daemon() {
  daemon_ = Process({DROVERD_PROGRAM, "-c", log("drover.json")}, log("droverd.log"));
}

void RobotRig::start_daemon(const std::string& first, std::vector<std::string> wrapper) {
  wrapper.insert(
      wrapper.end(),
      {"/bin/sh", "-c", first + "; exec " + DROVERD_PROGRAM + " -c " + log("drover.json")});
  daemon_ = Process(wrapper, log("droverd.log"));
}

void RobotRig::edit(const char* name, std::string_view from, const std::string& to) {
  std::ifstream file(folder_ / name);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  ASSERT_NE(text.find(from), std::string::npos) << from;
  std::ofstream(folder_ / name) << filled(text, from, to);
}

void RobotRig::set_broker_host(const std::string& host) {
  edit("drover.json", R"("mqtt": {"port")", R"("mqtt": {"host": ")" + host + R"(", "port")");
}

void RobotRig::add_section(const std::string& section) {
  edit("drover.json", R"("mqtt": {)", section + R"(, "mqtt": {)");
}

void RobotRig::start_all() {
  ASSERT_NO_FATAL_FAILURE(remember_its_first_way());
  ASSERT_NO_FATAL_FAILURE(start_new());
}

void RobotRig::start_new() {
  ASSERT_NO_FATAL_FAILURE(start_broker());
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon();
  ASSERT_TRUE(wait_for_locate());
}

void RobotRig::remember_its_first_way() {
  std::ifstream file(folder_ / "drover.json");
  const std::string configuration((std::istreambuf_iterator<char>(file)), {});
  std::vector<std::string> report;
  runtime::RobotMemory memory(log("run"), runtime::boot_id(), configuration, report);
  Remembered before;
  before.mechanics_proved = true;
  ASSERT_TRUE(memory.keep(before));
  ASSERT_TRUE(report.empty()) << report.front();
}

void RobotRig::stop_daemon() {
  daemon_.signal(SIGTERM);
  EXPECT_EQ(daemon_.wait(deadline()), 0) << daemon_.output();
}

bool RobotRig::wait_until(const std::function<bool()>& done) {
  return wait_until(done, deadline());
}

bool RobotRig::wait_until(const std::function<bool()>& done, std::chrono::nanoseconds longest) {
  const auto end = std::chrono::steady_clock::now() + longest;
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

double RobotRig::now_s() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace drover::test
