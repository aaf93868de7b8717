// A broker that does what a test says and nothing by itself: packets of MQTT over a socket of the
// loopback, read and written when the test turns it.
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "link/unique_fd.h"

namespace drover::runtime {

class FakeBroker final {
 public:
  /// MQTT 3.1.1, 2.2.1: the packet's type, its four upper bits.
  enum Type : unsigned {
    kConnect = 1,
    kConnack,
    kPublish,
    kPuback,
    kSubscribe = 8,
    kSuback,
    kPingReq = 12,
    kPingResp
  };
  struct Packet {
    unsigned type = 0;
    unsigned flags = 0;
    std::string body;
  };

  FakeBroker() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    (void)::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size);
    (void)::listen(listener_.get(), 8);
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ::ntohs(address.sin_port);
  }
  int port() const { return port_; }

  /// Takes a connection that waits and everything that came on the present one.
  void turn() {
    link::UniqueFd fresh(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK));
    if (fresh) {
      client_ = std::move(fresh);
      in_.clear();
      ++connections;
    }
    std::array<char, 4096> chunk{};
    for (ssize_t n = 0; client_ && (n = ::recv(client_.get(), chunk.data(), chunk.size(), 0)) > 0;)
      in_.append(chunk.data(), static_cast<std::size_t>(n));
    while (take_packet()) {
    }
  }
  void close() { client_.reset(); }

  void send(unsigned type, unsigned flags, const std::string& body) const {
    std::string packet(1, static_cast<char>(type << 4U | flags));
    std::size_t size = body.size();
    do {
      packet.push_back(static_cast<char>((size & 0x7FU) | (size > 0x7F ? 0x80U : 0U)));
      size >>= 7U;
    } while (size > 0);
    packet += body;
    (void)!::send(client_.get(), packet.data(), packet.size(), MSG_NOSIGNAL);
  }
  /// `code` as the version of the last CONNECT writes it.
  void accept(unsigned code = 0) const {
    std::string body{'\0', static_cast<char>(code)};
    if (version() == 5) body.push_back('\0');  // no properties
    send(kConnack, 0, body);
  }
  /// As MQTT 5: no packet may have more than 64 bytes.
  void accept_small_packets() const { send(kConnack, 0, std::string("\0\0\5\x27\0\0\0\x40", 8)); }
  void publish(const std::string& topic, const std::string& text, bool retain) const {
    std::string body{static_cast<char>(topic.size() >> 8U),
                     static_cast<char>(topic.size() & 0xFFU)};
    body += topic;
    if (version() == 5) body.push_back('\0');
    send(kPublish, retain ? 1 : 0, body + text);
  }
  /// Acknowledges the n-th packet, which is a PUBLISH of quality of service 1.
  void acknowledge(std::size_t n) const {
    const auto& body = packets.at(n).body;
    const auto topic = static_cast<std::size_t>(static_cast<unsigned char>(body[0]) << 8U |
                                                static_cast<unsigned char>(body[1]));
    send(kPuback, 0, body.substr(2 + topic, 2));
  }

  /// Of the last CONNECT; 0: there was none.
  int version() const {
    for (auto packet = packets.rbegin(); packet != packets.rend(); ++packet)
      if (packet->type == kConnect) return packet->body.at(6);
    return 0;
  }
  std::vector<std::size_t> all(unsigned type) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < packets.size(); ++i)
      if (packets[i].type == type) found.push_back(i);
    return found;
  }

  std::vector<Packet> packets;  ///< heard so far
  int connections = 0;

 private:
  bool take_packet() {
    std::size_t size = 0;
    std::size_t at = 1;
    for (unsigned shift = 0;; shift += 7, ++at) {
      if (at >= in_.size()) return false;
      size |= static_cast<std::size_t>(in_[at] & 0x7F) << shift;
      if ((static_cast<unsigned char>(in_[at]) & 0x80U) == 0) break;
    }
    ++at;
    if (in_.size() < at + size) return false;
    const unsigned head = static_cast<unsigned char>(in_[0]);
    packets.push_back({head >> 4U, head & 0x0FU, in_.substr(at, size)});
    in_.erase(0, at + size);
    return true;
  }

  link::UniqueFd listener_;
  link::UniqueFd client_;
  int port_ = 0;
  std::string in_;
};

}  // namespace drover::runtime
