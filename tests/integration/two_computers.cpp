#include "integration/two_computers.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace drover::test {
namespace {

constexpr const char* kCardHere = "02:00:00:00:00:01";
constexpr const char* kCardThere = "02:00:00:00:00:02";

[[noreturn]] void cannot(const std::string& what) {
  throw std::runtime_error("two computers cannot be played here: " + what + ": " +
                           std::strerror(errno));
}

void run(const std::string& command) {
  if (std::system(command.c_str()) != 0) cannot(command);
}

void put(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  if (!(out << text << std::flush)) cannot(file);
}

void enter_new() {
  const std::string user = std::to_string(::geteuid());
  const std::string group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWNET) == 0) return;
  // Nobody of this computer's: root in there.
  if (::unshare(CLONE_NEWNET | CLONE_NEWUSER) != 0) cannot("unshare");
  put("/proc/self/setgroups", "deny");
  put("/proc/self/uid_map", "0 " + user + " 1");
  put("/proc/self/gid_map", "0 " + group + " 1");
}

link::UniqueFd this_network() {
  link::UniqueFd fd(::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC));
  if (fd.get() < 0) cannot("/proc/self/ns/net");
  return fd;
}

std::uint16_t sum_of(const iphdr& header) {
  std::array<std::uint16_t, sizeof(iphdr) / 2> words{};
  std::memcpy(words.data(), &header, sizeof header);
  std::uint32_t sum = 0;
  for (const std::uint16_t word : words) sum += word;
  sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~(sum + (sum >> 16)));
}

}  // namespace

TwoComputers::TwoComputers() {
  enter_new();
  const auto there = this_network();
  enter_new();
  const auto here = this_network();
  run("ip link set lo up");
  run(std::string("ip link add wire address ") + kCardHere + " type veth peer name wire address " +
      kCardThere + " netns /proc/" + std::to_string(::getpid()) + "/fd/" +
      std::to_string(there.get()));
  run("ip address add 10.9.0.1/24 dev wire && ip link set wire up");
  for (const char* key : {"route_localnet", "accept_local"})
    put(std::string("/proc/sys/net/ipv4/conf/wire/") + key, "1");
  for (const char* where : {"all", "wire"})
    put(std::string("/proc/sys/net/ipv4/conf/") + where + "/rp_filter", "0");

  if (::setns(there.get(), CLONE_NEWNET) != 0) cannot("setns");
  run("ip address add 10.9.0.2/24 dev wire && ip link set wire up");
  card_ = link::UniqueFd(::socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETHERTYPE_IP)));
  card_index_ = static_cast<int>(::if_nametoindex("wire"));
  if (card_.get() < 0 || card_index_ == 0) cannot("a packet socket");
  if (::setns(here.get(), CLONE_NEWNET) != 0) cannot("setns");
}

void TwoComputers::send(Place from, Place to, std::span<const std::uint8_t> datagram) const {
  udphdr udp{};
  udp.source = htons(from.port);
  udp.dest = htons(to.port);
  udp.len = htons(static_cast<std::uint16_t>(sizeof udp + datagram.size()));  // its sum 0: none
  iphdr ip{};
  ip.version = 4;
  ip.ihl = sizeof ip / 4;
  ip.tot_len = htons(static_cast<std::uint16_t>(sizeof ip + sizeof udp + datagram.size()));
  ip.ttl = 64;
  ip.protocol = IPPROTO_UDP;
  ip.saddr = htonl(from.address);
  ip.daddr = htonl(to.address);
  ip.check = sum_of(ip);
  std::vector<std::uint8_t> packet(sizeof ip + sizeof udp + datagram.size());
  std::memcpy(packet.data(), &ip, sizeof ip);
  std::memcpy(packet.data() + sizeof ip, &udp, sizeof udp);
  std::memcpy(packet.data() + sizeof ip + sizeof udp, datagram.data(), datagram.size());

  sockaddr_ll card{};
  card.sll_family = AF_PACKET;
  card.sll_protocol = htons(ETHERTYPE_IP);
  card.sll_ifindex = card_index_;
  card.sll_halen = ETH_ALEN;
  if ((to.address >> 28) == 0xe)
    for (auto& byte : card.sll_addr) byte = 0xff;  // multicast: whoever is on the wire
  else
    card.sll_addr[0] = 2, card.sll_addr[5] = 1;  // kCardHere
  if (::sendto(card_.get(), packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&card),
               sizeof card) < 0)
    cannot("send");
}

}  // namespace drover::test
