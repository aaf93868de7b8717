#include "ros2/domain.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <linux/filter.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace drover::ros2 {
namespace {

/// Larger ones are neither sent nor taken: what a flood of them costs is bounded.
constexpr const char* kLargestSample = "64kB";
/// Processes that share a computer, as ROS 2 looks for them.
constexpr int kMostParticipants = 32;
constexpr char kLoopback[] = "lo";

bool hears_datagrams(int fd) {
  int type = 0;
  int family = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  size = sizeof family;
  if (::getsockopt(fd, SOL_SOCKET, SO_DOMAIN, &family, &size) != 0) return false;
  return family == AF_INET || family == AF_INET6;
}

/// What did not come over the loopback device is dropped, whatever it says where it is from or to.
/// A socket that is bound to that device (SO_BINDTODEVICE) would not get what a program here sends
/// to this computer's own address on a network, though it comes over loopback as well: for the
/// kernel that is of the network's device. Programs of ROS 2 that are told to stay here as Jazzy
/// does send there.
bool takes_loopback_only(int fd) {
  const auto lo = ::if_nametoindex(kLoopback);
  if (lo == 0) return false;
  constexpr auto kCameOver = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
  constexpr std::uint32_t kWhole = 0xFFFF'FFFF;
  std::array<sock_filter, 4> rules{
      {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kCameOver), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, lo, 0, 1),
       BPF_STMT(BPF_RET | BPF_K, kWhole), BPF_STMT(BPF_RET | BPF_K, 0)}};
  const sock_fprog program{static_cast<unsigned short>(rules.size()), rules.data()};
  const int yes = 1;
  return ::setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0 &&
         ::setsockopt(fd, SOL_SOCKET, SO_LOCK_FILTER, &yes, sizeof yes) == 0;
}

/// One that has an address of its own is for sending: nothing leaves this computer by it.
bool sends_to_loopback_only(int fd) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
  const bool is_ip4 = address.sin_family == AF_INET;
  if (is_ip4 && address.sin_addr.s_addr == htonl(INADDR_ANY)) return true;
  return ::setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, kLoopback, sizeof kLoopback - 1) == 0;
}

std::string why(const char* what, dds_return_t code) {
  return std::string(what) + ": " + dds_strretcode(code);
}

}  // namespace

std::string domain_settings(Reach reach, const std::optional<Network>& network) {
  const bool open = reach == Reach::network && network;
  std::string text = "<CycloneDDS><Domain id=\"any\"><General><Interfaces>";
  // Both: of programs that were told to stay on this computer some use lo, others their network's
  // own address. A loopback that took no multicast would end it on the network as well.
  text += open ? "<NetworkInterface name=\"lo\" multicast=\"true\"/>"
               : "<NetworkInterface name=\"lo\"/>";
  if (network) text += "<NetworkInterface address=\"" + network->address + "\"/>";
  text += "</Interfaces>";
  if (!open) text += "<AllowMulticast>false</AllowMulticast>";
  text +=
      "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
      std::to_string(kMostParticipants) +
      "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers>"
      "</Discovery><Internal><MaxSampleSize>" +
      std::string(kLargestSample) + "</MaxSampleSize></Internal></Domain></CycloneDDS>";
  return text;
}

std::size_t close_to_networks() {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/proc/self/fd"), ::closedir);
  if (!folder) throw NoDomain("its sockets cannot be listed, so they cannot be closed");
  std::size_t closed = 0;
  while (const dirent* entry = ::readdir(folder.get())) {
    char* end = nullptr;
    const long fd = std::strtol(entry->d_name, &end, 10);
    if (end == entry->d_name || *end != '\0' || !hears_datagrams(static_cast<int>(fd))) continue;
    if (!takes_loopback_only(static_cast<int>(fd)) || !sends_to_loopback_only(static_cast<int>(fd)))
      throw NoDomain(std::string("its sockets cannot be closed to networks: ") +
                     std::strerror(errno));
    ++closed;
  }
  return closed;
}

Domain::Domain(int number, Reach reach, const std::optional<Network>& network) {
  // A participant of a domain that could not be made would have the defaults: all networks.
  domain_ = dds_create_domain(static_cast<dds_domainid_t>(number),
                              domain_settings(reach, network).c_str());
  if (domain_ < 0) throw NoDomain(why("the DDS domain cannot be made", domain_));
  dds_qos_t* qos = dds_create_qos();
  constexpr std::string_view kEnclave = "enclave=/;";
  dds_qset_userdata(qos, kEnclave.data(), kEnclave.size());
  participant_ = dds_create_participant(static_cast<dds_domainid_t>(number), qos, nullptr);
  dds_delete_qos(qos);
  try {
    if (participant_ < 0) throw NoDomain(why("no DDS participant can be made", participant_));
    // Before there is any reader or writer.
    if (reach == Reach::localhost && close_to_networks() == 0)
      throw NoDomain("none of its sockets was found, so they cannot be closed to networks");
  } catch (...) {
    dds_delete(domain_);
    throw;
  }
}

Domain::~Domain() {
  dds_delete(domain_);
}

}  // namespace drover::ros2
