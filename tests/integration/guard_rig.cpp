#include "integration/guard_rig.h"

#include <fcntl.h>
#include <linux/can.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace drover::test {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  return address;
}

std::string value_of(const std::string& words, const std::string& key) {
  const auto at = words.find(key + "=");
  if (at == std::string::npos) return {};
  const auto begin = at + key.size() + 1;
  return words.substr(begin, words.find('\n', begin) - begin);
}

bool same_file(int a, int b) {
  struct stat one {
  }, two{};
  constexpr int kKcmpFile = 0;
  const auto self = ::getpid();
  const auto answer = ::syscall(SYS_kcmp, self, self, kKcmpFile, a, b);
  if (answer >= 0) return answer == 0;
  return ::fstat(a, &one) == 0 && ::fstat(b, &two) == 0 && one.st_ino == two.st_ino &&
         one.st_dev == two.st_dev;
}

bool hung_up(int fd) {
  pollfd fds{fd, 0, 0};
  return ::poll(&fds, 1, 0) > 0 && (fds.revents & (POLLHUP | POLLERR)) != 0;
}

}  // namespace

ServiceManager::ServiceManager(std::string path)
    : path_(std::move(path)), fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  ::unlink(path_.c_str());
  const auto address = address_of(path_);
  if (::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("no notify socket");
}

void ServiceManager::take() {
  for (;;) {
    std::array<char, 4096> bytes{};
    iovec vector{bytes.data(), bytes.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &vector;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const auto n = ::recvmsg(fd_.get(), &header, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    if (n < 0) return;
    int fd = -1;
    if (const auto* c = CMSG_FIRSTHDR(&header); c != nullptr && c->cmsg_type == SCM_RIGHTS)
      std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
    const std::string words(bytes.data(), static_cast<std::size_t>(n));
    words_ += words + "\n";
    store(words, link::UniqueFd(fd));
  }
}

void ServiceManager::store(const std::string& words, link::UniqueFd fd) {
  const auto name = value_of(words, "FDNAME");
  if (!value_of(words, "FDSTOREREMOVE").empty()) {
    std::erase_if(kept_, [&](const auto& one) { return one.name == name; });
    return;
  }
  if (value_of(words, "FDSTORE").empty() || !fd) return;
  const bool known = std::any_of(kept_.begin(), kept_.end(), [&](const auto& one) {
    return same_file(one.fd.get(), fd.get());
  });
  if (known) return;
  if (value_of(words, "FDPOLL") != "0" && hung_up(fd.get())) return;
  kept_.push_back({name, std::move(fd)});
}

bool ServiceManager::heard(const std::string& words) {
  take();
  return words_.find(words) != std::string::npos;
}

std::vector<KeptDescriptor>& ServiceManager::kept() {
  take();
  return kept_;
}

bool ServiceManager::keeps(const std::string& name) {
  const auto& all = kept();
  return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
}

void ServiceManager::stop_reading() {
  const link::UniqueFd filler(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto address = address_of(path_);
  while (::sendto(filler.get(), "X", 1, 0, reinterpret_cast<const sockaddr*>(&address),
                  sizeof address) == 1) {
  }
}

GuardRig::GuardRig() {
  auto name = (std::filesystem::temp_directory_path() / "drover-guard-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  new_daemon();
}

GuardRig::~GuardRig() {
  kill();
  if (HasFailure()) std::fprintf(stderr, "---- guard\n%s", output().c_str());
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void GuardRig::new_daemon() {
  client_.reset();
  memory_ = std::make_unique<runtime::GuardMemory>();
  client_ = std::make_unique<runtime::GuardClient>(file("guard.sock"), 50, *memory_);
}

void GuardRig::start(const Start& how) {
  std::vector<std::string> words{DROVER_GUARD_PROGRAM, "--socket", file("guard.sock")};
  if (!how.user.empty()) words.insert(words.end(), {"--user", how.user});
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<int> kept;
  std::string names;
  if (how.manager != nullptr) {
    for (const auto& one : how.manager->kept()) {
      names += (kept.empty() ? "" : ":") + one.name;
      kept.push_back(one.fd.get());
    }
  }
  std::filesystem::remove(folder_ / "stop.sock");
  const auto log = file("guard.log");
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int error = how.standard_error >= 0
                          ? how.standard_error
                          : ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(error, STDERR_FILENO);
    if (how.manager != nullptr) ::setenv("NOTIFY_SOCKET", how.manager->path().c_str(), 1);
    // Out of the way first: one may lie where another has to go.
    for (int& fd : kept) fd = ::fcntl(fd, F_DUPFD, 100);
    for (std::size_t i = 0; i < kept.size(); ++i) ::dup2(kept[i], 3 + static_cast<int>(i));
    for (const int fd : kept) ::close(fd);
    ::setenv("LISTEN_PID", std::to_string(::getpid()).c_str(), 1);
    ::setenv("LISTEN_FDS", std::to_string(kept.size()).c_str(), 1);
    ::setenv("LISTEN_FDNAMES", names.c_str(), 1);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  if (!how.wait) return;
  // Its file is there a moment before anybody may connect.
  ASSERT_TRUE(wait_until([this] { return static_cast<bool>(to_stop_socket()); })) << output();
}

void GuardRig::kill() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

int GuardRig::wait_for_end() {
  int status = -1;
  if (!wait_until([&] { return ::waitpid(pid_, &status, WNOHANG) == pid_; })) return -1;
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

runtime::GuardedLink GuardRig::can_link(const std::string& name,
                                        const std::vector<unsigned>& addresses) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
    throw std::runtime_error("no socket pair");
  std::erase_if(drives_, [&](const auto& one) { return one.first == name; });
  drives_.emplace_back(name, link::UniqueFd(ends[0]));
  auto link = absent_link(name, addresses);
  link.descriptor = link::UniqueFd(ends[1]);
  return link;
}

runtime::GuardedLink GuardRig::absent_link(const std::string& name,
                                           const std::vector<unsigned>& addresses) {
  runtime::GuardedLink link;
  link.name = name;
  for (const auto address : addresses) {
    CanFrame frame;
    frame.id = address;
    frame.len = 8;
    StopRound round;
    static_cast<void>(round.frames.push_back(frame));
    StopRecipe stop;
    static_cast<void>(stop.rounds.push_back(round));
    link.axes.push_back(runtime::guarded_axis(name, stop));
  }
  return link;
}

std::vector<unsigned> GuardRig::frames(const std::string& name) {
  std::vector<unsigned> ids;
  for (const auto& [link, fd] : drives_) {
    can_frame frame{};
    while (link == name && ::recv(fd.get(), &frame, sizeof frame, MSG_DONTWAIT) == sizeof frame)
      ids.push_back(frame.can_id);
  }
  return ids;
}

bool GuardRig::hand_over(std::vector<runtime::GuardedLink> links) {
  std::string problem;
  const bool done = client_->hand_over(links, problem);
  EXPECT_TRUE(done) << problem;
  return done;
}

bool GuardRig::hand_over_one_drive() {
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  return hand_over(std::move(links));
}

bool GuardRig::beat(std::chrono::milliseconds time, const std::function<bool()>& done) {
  const auto end = Clock::now() + time;
  while (Clock::now() < end) {
    shared().daemon_beats.fetch_add(1);
    if (done && done()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

bool GuardRig::wait_until(const std::function<bool()>& done) {
  const auto end = Clock::now() + 10s;
  while (Clock::now() < end) {
    if (done()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

link::UniqueFd GuardRig::to_stop_socket() const {
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  const auto address = address_of(file("stop.sock"));
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    fd.reset();
  return fd;
}

std::string GuardRig::at_stop_socket(const std::string& word) const {
  const link::UniqueFd fd = to_stop_socket();
  if (!fd) return "no answer";
  const timeval patience{5, 0};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  if (::send(fd.get(), word.data(), word.size(), MSG_NOSIGNAL) < 0) return "no answer";
  std::array<char, 1024> answer{};
  const auto n = ::recv(fd.get(), answer.data(), answer.size(), 0);
  return n <= 0 ? "no answer" : std::string(answer.data(), static_cast<std::size_t>(n));
}

std::string GuardRig::output() const {
  std::ostringstream text;
  text << std::ifstream(folder_ / "guard.log").rdbuf();
  return text.str();
}

}  // namespace drover::test
