#include "link/modbus_link.h"

#include <fcntl.h>
#include <modbus.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "drover/baud.h"
#include "drover/bytes.h"
#include "link/unique_fd.h"

namespace drover::link {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLongestReply = 1s;
/// A device's worst reply time, as far as anybody knows; see ready_at().
constexpr Duration kFirstSettle = 1s;
constexpr int kMostDoublings = 2;
/// A connection on which so many requests were not answered is made anew: the peer may be gone
/// without a word.
constexpr int kTcpMostUnanswered = 3;

/// In which an answer to the last of so many unanswered requests may still come.
Duration settle(int unanswered) {
  return kFirstSettle * (1 << std::min(unanswered - 1, kMostDoublings));
}

}  // namespace

void ModbusLink::Closer::operator()(_modbus* context) const {
  if (context == nullptr) return;
  const int fd = modbus_get_socket(context);
  // What nobody takes would hold the closing up for half a minute.
  if (fd >= 0) ::tcflush(fd, TCIOFLUSH);
  modbus_close(context);
  modbus_free(context);
}

ModbusLink::ModbusLink(Context context, const ModbusSettings& settings, NowFunction now)
    : context_(std::move(context)),
      now_(now),
      fd_(modbus_get_socket(context_.get())),
      tcp_(settings.port.starts_with("tcp:")),
      used_(now()) {}

Time ModbusLink::ready_at(const ModbusUnit& unit) const {
  return std::max(used_ + from_s(unit.gap_s), owed_[unit.address].until);
}

bool ModbusLink::send(std::span<const std::uint8_t> bytes) {
  // Never more than a dozen bytes into an empty queue: less than all means that nobody takes them.
  const auto n = tcp_ ? ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT)
                      : ::write(fd_, bytes.data(), bytes.size());
  if (n == static_cast<ssize_t>(bytes.size())) return true;
  error_ = n < 0 ? errno : EIO;
  return false;
}

bool ModbusLink::receive() {
  std::array<std::uint8_t, 256> chunk{};
  const auto n = tcp_ ? ::recv(fd_, chunk.data(), chunk.size(), MSG_DONTWAIT)
                      : ::read(fd_, chunk.data(), chunk.size());
  if (n > 0) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      if (bytes_.full()) {  // noise without an end: the newest half may hold the answer
        const std::size_t half = bytes_.capacity() / 2;
        std::copy(bytes_.begin() + half, bytes_.end(), bytes_.begin());
        bytes_.resize(half);
      }
      (void)bytes_.push_back(chunk[i]);
    }
    return true;
  }
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return true;
  error_ = n < 0 ? errno : EIO;  // readable without a byte: it hung up
  return false;
}

bool ModbusLink::drain() {
  bytes_.clear();
  const bool there = receive();
  if (!bytes_.empty()) {
    counters_.late_bytes += bytes_.size();
    used_ = now_();
    for (Owed& owed : owed_)
      if (owed.unanswered > 0 && !tcp_)
        owed.until = std::max(owed.until, used_ + settle(owed.unanswered));
  }
  return there;
}

FoundAnswer ModbusLink::look(const ModbusUnit& unit, const RegisterBlock& block) const {
  return tcp_ ? find_tcp_answer(bytes_, transaction_, unit.address, block)
              : find_rtu_answer(bytes_, unit.address, block);
}

bool ModbusLink::ask(const ModbusUnit& unit, const RegisterBlock& block) {
  bytes_.clear();
  if (!tcp_) ::tcflush(fd_, TCIOFLUSH);
  ++counters_.requests;
  ++transaction_;
  return tcp_ ? send(tcp_read_request(transaction_, unit.address, block))
              : send(rtu_read_request(unit.address, block));
}

std::optional<FoundAnswer> ModbusLink::await(const ModbusUnit& unit, const RegisterBlock& block,
                                             Time now, Time deadline) {
  FoundAnswer found;
  for (; now < deadline; now = now_()) {
    const Duration left = deadline - now;
    const timespec wait{static_cast<time_t>(left / 1s), static_cast<long>((left % 1s).count())};
    pollfd line{fd_, POLLIN, 0};
    const int n = ::ppoll(&line, 1, &wait, nullptr);
    if (n == 0) break;
    if (n < 0) continue;  // a signal
    if (!receive()) return std::nullopt;
    found = look(unit, block);
    if (found.answer == Answer::good || found.answer == Answer::exception) break;
    if (tcp_ && found.answer == Answer::damaged) break;
  }
  return found;
}

void ModbusLink::note_spoken(const ModbusUnit& unit, bool answered) {
  unanswered_ = answered ? 0 : unanswered_ + 1;
  used_ = now_();
  Owed& owed = owed_[unit.address];
  owed = {answered ? 0 : owed.unanswered + 1, kNever};
  // Over TCP a late answer has another transaction: nothing to wait for.
  if (!answered && !tcp_) owed.until = used_ + settle(owed.unanswered);
}

ModbusResult ModbusLink::read(const ModbusUnit& unit, const RegisterBlock& block,
                              std::span<std::uint16_t> words) {
  const ModbusResult gone{false, RegisterFailure::link, 0};
  if (words.size() != block.count || block.count < 1 || block.count > 125)
    return {false, RegisterFailure::damaged, 0};
  const Time begin = now_();
  const Time deadline = begin + std::min(from_s(unit.reply_s), kLongestReply);
  if (!ask(unit, block)) return gone;
  const auto found = await(unit, block, begin, deadline);
  if (!found) return gone;
  counters_.echoes += found->echoes;
  const ModbusResult result = finish(*found, words);
  const bool answered = result.good || result.failure == RegisterFailure::refused;
  note_spoken(unit, answered);
  // What is left of a broken frame has no end on a stream.
  const bool lost_step = found->answer == Answer::damaged || found->answer == Answer::incomplete;
  if (tcp_ && !answered && (lost_step || unanswered_ >= kTcpMostUnanswered)) {
    error_ = ETIMEDOUT;
    return gone;
  }
  return result;
}

ModbusResult ModbusLink::finish(const FoundAnswer& found, std::span<std::uint16_t> words) {
  switch (found.answer) {
    case Answer::nothing:
    case Answer::incomplete: return {false, RegisterFailure::silent, 0};
    case Answer::wrong_unit: return {false, RegisterFailure::wrong_unit, 0};
    case Answer::exception: return {false, RegisterFailure::refused, found.exception};
    case Answer::damaged: return {false, RegisterFailure::damaged, 0};
    case Answer::good: break;
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = load_be<std::uint16_t>({bytes_.begin(), bytes_.size()}, found.data + 2 * i);
  }
  ++counters_.answers;
  return {true, {}, 0};
}

namespace {

Opened<ModbusLink> failed(const std::string& port, const char* what, int error) {
  Opened<ModbusLink> opened;
  opened.problem = problem_text(port, what, error);
  return opened;
}

ModbusLink::Context make_context(const ModbusSettings& settings) {
  if (!settings.port.starts_with("tcp:"))
    return ModbusLink::Context(
        modbus_new_rtu(settings.port.c_str(), settings.baud, settings.parity, 8, 1));
  const auto colon = settings.port.rfind(':');
  const auto address = settings.port.substr(4, colon - 4);
  return ModbusLink::Context(
      modbus_new_tcp(address.c_str(), std::atoi(settings.port.c_str() + colon + 1)));
}

/// libmodbus waits for a connection with select(), which must not see a descriptor beyond its set.
bool descriptors_left() {
  const UniqueFd probe(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  return probe && probe.get() < FD_SETSIZE - 8;
}

}  // namespace

Opened<ModbusLink> open_modbus(const ModbusSettings& settings, NowFunction now) {
  const bool tcp = settings.port.starts_with("tcp:");
  if (!tcp &&
      std::find(kModbusBauds.begin(), kModbusBauds.end(), settings.baud) == kModbusBauds.end()) {
    Opened<ModbusLink> opened;
    opened.problem =
        settings.port + ": baud rate " + std::to_string(settings.baud) + " is not supported";
    return opened;
  }
  if (!descriptors_left()) return failed(settings.port, "cannot open", EMFILE);
  auto context = make_context(settings);
  if (!context) return failed(settings.port, "cannot open", errno);
  modbus_set_response_timeout(context.get(), 0, 900'000);  // here: of connecting
  if (modbus_connect(context.get()) != 0) {
    // A connection that nobody answers leaves "in progress" behind.
    const int error = errno == EINPROGRESS ? ETIMEDOUT : errno;
    return failed(settings.port, tcp ? "cannot connect" : "cannot open", error);
  }
  const int fd = modbus_get_socket(context.get());
  if (tcp) {
    const int on = 1;
    ::setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  } else {
    Opened<ModbusLink> opened;
    if (::isatty(fd) == 0) return failed(settings.port, "is no serial line", ENOTTY);
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      opened.problem = settings.port + ": another program uses this line";
      return opened;
    }
    ::ioctl(fd, TIOCEXCL);
  }
  Opened<ModbusLink> opened;
  opened.link = std::make_unique<ModbusLink>(std::move(context), settings, now);
  return opened;
}

}  // namespace drover::link
