#include "integration/ros2_rig.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "publish/cli_outlet.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
constexpr publish::ClientId kClient = 7;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

Ros2Rig::Ros2Rig(User user, const std::string& more) {
  auto config = text_of(std::filesystem::path(DROVER_SOURCE_DIR) / "config/examples/lidar.json");
  const std::string sections = "{\n  \"ros2\": {\"domain\": " + std::to_string(domain_) + more +
                               "},\n  \"paths\": {\"run\": \"" + folder_.string() +
                               "\", \"state\": \"" + folder_.string() + "\"},";
  config.replace(config.find("\n{") + 1, 1, sections);
  std::ofstream(folder_ / "drover.json") << config;
  dds_ = dds_create_domain(static_cast<dds_domainid_t>(domain_), settings_of(user).c_str());
  EXPECT_GT(dds_, 0);
  participant_ = dds_create_participant(static_cast<dds_domainid_t>(domain_), nullptr, nullptr);
  EXPECT_GT(participant_, 0);
  turns_.resize(1);
  turns_[0].device = "lidar";
  turns_[0].scan.turn_Hz = 10;
  (void)turns_[0].scan.points.push_back({0.5, 2.5, 9});
}

Ros2Rig::~Ros2Rig() {
  give_back();
  program_ = {};
  dds_delete(dds_);
  close_daemon();
}

void Ros2Rig::start_program() {
  program_ = Process({DROVER_ROS2_PROGRAM, "--config", (folder_ / "drover.json").string()},
                     (folder_ / "log").string());
}

void Ros2Rig::open_daemon() {
  outlet_ = std::make_unique<publish::Ros2Outlet>(
      50,
      [this] {
        std::vector<const scene::sensor::SeenTurn*> seen;
        for (const auto& turn : turns_) seen.push_back(&turn);
        return seen;
      },
      publish::Ros2Inputs{.cmd_vel = true});
  const auto path = folder_ / "drover.sock";
  std::filesystem::remove(path);
  listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(listener_, 4), 0);
}

void Ros2Rig::close_daemon() {
  for (int* fd : {&client_, &listener_}) {
    if (*fd >= 0) ::close(*fd);
    *fd = -1;
  }
}

void Ros2Rig::hear() {
  if (client_ < 0 && listener_ >= 0) client_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (client_ < 0) return;
  std::array<char, 4096> block{};
  const auto n = ::recv(client_, block.data(), block.size(), MSG_DONTWAIT);
  if (n == 0) {
    ::close(client_);
    client_ = -1;
  }
  if (n > 0) in_.append(block.data(), static_cast<std::size_t>(n));
  for (auto end = in_.find('\n'); end != std::string::npos; end = in_.find('\n')) {
    const std::string line = in_.substr(0, end);
    in_.erase(0, end + 1);
    if (publish::is_stop_line(line)) {
      ++stops_;
      if (refused_stops_ > 0) {
        --refused_stops_;
        tell(R"({"ok":false,"cmd":"stop","reason":"the control loop has not answered"})");
        continue;
      }
      if (answers_stops_) tell(R"({"ok":true,"note":""})");
      continue;
    }
    if (line.find("ros2_follow") != std::string::npos) last_request_ = line;
    if (line.find(R"("cmd":"joint_command")") != std::string::npos) last_joint_line_ = line;
    if (line.find("scene_message") != std::string::npos) last_scene_line_ = line;
    publish::Actions out;
    EXPECT_TRUE(outlet_->on_line(kClient, line, seen_.time, out)) << line;
    for (const auto& action : out)
      if (const auto* command = std::get_if<Command>(&action)) commands_.push_back(*command);
  }
}

/// One cycle of droverd: the robot as it is now.
void Ros2Rig::beat() {
  seen_.time = runtime::monotonic_now();
  seen_.imu.time = seen_.gnss.position_time = seen_.odometry.time = seen_.pose.time = seen_.time;
  seen_.battery.time = seen_.time;
  for (AxisSnapshot& axis : seen_.axes) axis.last_motion = seen_.time;
  for (auto& turn : turns_) {
    turn.scan.begin = seen_.time - 100ms;
    turn.scan.end = seen_.time;
  }
  hear();
  if (client_ < 0) return;
  publish::Actions out;
  (void)outlet_->on_snapshot(seen_, {seen_.time, runtime::wall_minus_monotonic()}, out);
  for (const auto& action : out) tell(std::get<publish::Reply>(action).line);
}

void Ros2Rig::tell(const std::string& line) const {
  const std::string text = line + "\n";
  (void)!::send(client_, text.data(), text.size(), MSG_NOSIGNAL);
}

bool Ros2Rig::play_until(const std::function<bool()>& done) {
  const auto until = runtime::monotonic_now() + 30s;
  while (!done()) {
    if (runtime::monotonic_now() > until) return false;
    beat();
    std::this_thread::sleep_for(20ms);
  }
  return true;
}

void Ros2Rig::play_for(std::chrono::milliseconds time) {
  const auto until = runtime::monotonic_now() + time;
  (void)play_until([until] { return runtime::monotonic_now() >= until; });
}

dds_entity_t Ros2Rig::reader(ros2::Topic topic, dds_reliability_kind_t reliability,
                             dds_durability_kind_t durability) {
  return make_reader(participant_, ros2::topic_kinds().at(static_cast<std::size_t>(topic)),
                     reliability, durability);
}

void Ros2Rig::give_back() {
  if (loan_ != nullptr) dds_return_loan(loan_of_, &loan_, 1);
  loan_ = nullptr;
}

}  // namespace drover::test
