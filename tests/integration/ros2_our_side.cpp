#include "integration/ros2_our_side.h"

#include <arpa/inet.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "integration/ros2_user.h"
#include "ros2/domain.h"
#include "ros2/networks.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

std::string interface_settings(const char* which) {
  return std::string("<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface ") +
         which +
         "/></Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
         "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
         "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
         "</Domain></CycloneDDS>";
}

/// Of all sockets: those that are none refuse it.
void bind_to_loopback() {
  for (int fd = 0; fd < 256; ++fd) ::setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, "lo", 2);
}

/// Our participant, which lives as long as this process.
dds_entity_t make(Ours ours) {
  if (ours == Ours::shipped_localhost || ours == Ours::shipped_network) {
    const auto reach =
        ours == Ours::shipped_network ? ros2::Reach::network : ros2::Reach::localhost;
    static const ros2::Domain kShipped(kMeetingDomain, reach,
                                       ros2::chosen(ros2::networks(), "", std::nullopt));
    return kShipped.participant();
  }
  const auto settings =
      interface_settings(ours == Ours::loopback_only ? "name=\"lo\"" : "autodetermine=\"true\"");
  if (dds_create_domain(kMeetingDomain, settings.c_str()) < 0)
    throw std::runtime_error("no domain");
  const dds_entity_t participant = dds_create_participant(kMeetingDomain, nullptr, nullptr);
  if (ours == Ours::automatic_bound) bind_to_loopback();
  return participant;
}

/// The ports by which a program is looked for, each taken by nobody who answers.
void take_indices(int count) {
  for (int i = 0; i < count; ++i) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in port{};
    port.sin_family = AF_INET;
    port.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * kMeetingDomain + 10 + 2 * i));
    if (::bind(fd, reinterpret_cast<sockaddr*>(&port), sizeof port) != 0)
      throw std::runtime_error("a port of DDS is taken");
  }
}

void write_for_ever(Ours ours, int before) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  take_indices(before);
  const dds_entity_t writer = make_writer(make(ours), meeting_topic(), DDS_RELIABILITY_RELIABLE);
  for (;;) {
    nav_msgs_msg_dds__Odometry_ message{};
    dds_write(writer, &message);
    std::this_thread::sleep_for(50ms);
  }
}

}  // namespace

const ros2::TopicKind& meeting_topic() {
  return ros2::topic_kinds()[static_cast<std::size_t>(ros2::Topic::odom)];
}

OurSide::OurSide(Ours ours, int before) : process_(::fork()) {
  if (process_ < 0) throw std::runtime_error("no process for our side");
  if (process_ > 0) return;
  try {
    write_for_ever(ours, before);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
  }
  ::_exit(1);
}

OurSide::~OurSide() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool OurSide::alive() const {
  return ::waitpid(process_, nullptr, WNOHANG) == 0;
}

}  // namespace drover::test
