#include "sim/scenario/status_client.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>

#include "link/unix_address.h"

namespace drover::sim {

void StatusClient::ask() {
  if (fd_) return;
  const auto address = link::unix_address(path_);
  if (!address) return;
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  constexpr std::string_view kQuestion = "{\"cmd\":\"status\"}\n";
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
      ::send(fd.get(), kQuestion.data(), kQuestion.size(), MSG_NOSIGNAL) < 0) {
    status_ = nullptr;
    return;
  }
  reply_.clear();
  fd_ = std::move(fd);
}

void StatusClient::on_readable() {
  std::array<char, 16384> text{};
  const auto n = ::recv(fd_.get(), text.data(), text.size(), 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (n > 0) reply_.append(text.data(), static_cast<std::size_t>(n));
  if (n > 0 && reply_.back() != '\n') return;
  fd_.reset();
  const auto reply = nlohmann::json::parse(reply_, nullptr, false);
  status_ = reply.is_object() ? reply.value("status", nlohmann::json()) : nlohmann::json();
}

}  // namespace drover::sim
