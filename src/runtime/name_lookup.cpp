#include "runtime/name_lookup.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <thread>

#include "runtime/worker.h"

namespace drover::runtime {

namespace {

/// One address a line, or '!' and the problem.
std::string resolved(const std::string& host) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), nullptr, &hints, &list); code != 0)
    return std::string("!") + ::gai_strerror(code);
  std::string text;
  for (const auto* one = list; one != nullptr; one = one->ai_next) {
    std::array<char, NI_MAXHOST> name{};
    if (::getnameinfo(one->ai_addr, one->ai_addrlen, name.data(), name.size(), nullptr, 0,
                      NI_NUMERICHOST) == 0)
      text.append(name.data()).push_back('\n');
  }
  ::freeaddrinfo(list);
  return text.empty() ? "!no address" : text;
}

void answer(const std::string& host, const link::UniqueFd& to) {
  name_thread("names");
  const auto text = resolved(host);
  // Whoever asked may be gone: then nobody hears it, and no signal comes of it.
  (void)!::send(to.get(), text.data(), text.size(), MSG_NOSIGNAL);
}

}  // namespace

void NameLookup::ask(const std::string& host) {
  if (under_way()) return;
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  answer_ = link::UniqueFd(ends[0]);
  text_.clear();
  try {
    std::thread([host, to = link::UniqueFd(ends[1])] { answer(host, to); }).detach();
  } catch (const std::system_error&) {  // no thread to be had: the next try asks again
    answer_.reset();
  }
}

std::optional<NameLookup::Answer> NameLookup::take() {
  if (!under_way()) return std::nullopt;
  std::array<char, 4096> chunk{};
  for (;;) {
    const auto n = ::recv(answer_.get(), chunk.data(), chunk.size(), MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::nullopt;  // not yet
    if (n == 0) break;
    text_.append(chunk.data(), static_cast<std::size_t>(n));
  }
  answer_.reset();
  Answer answer;
  std::istringstream lines(text_);
  for (std::string line; std::getline(lines, line);) {
    if (line.front() == '!') {
      answer.problem = line.substr(1);
    } else {
      answer.addresses.push_back(line);
    }
  }
  if (answer.addresses.empty() && answer.problem.empty()) answer.problem = "no answer";
  return answer;
}

bool is_numeric(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return host.starts_with('/') || ::inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

}  // namespace drover::runtime
