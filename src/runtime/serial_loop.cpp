#include "runtime/serial_loop.h"

#include <algorithm>

#include "drover/driver.h"
#include "link/serial_link.h"
#include "runtime/clock.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// Who looks so often and finds nothing knows of what comes next that it is no older.
constexpr Duration kLookEach = 50ms;
/// What may have waited for longer has no time that anybody could give it: told at the time of the
/// read it would be taken for young, told as old as it can be for a position of before it was
/// measured.
constexpr Duration kTooLong = 250ms;

}  // namespace

bool too_old(const Listened& listened) {
  return listened.ended - listened.began > kTooLong;
}

Time first_came_in(const Listened& listened) {
  const auto before_last = static_cast<std::int64_t>(listened.size) - 1;
  return listened.ended - listened.byte_time * std::max<std::int64_t>(before_last, 0);
}

SerialLoop::SerialLoop(const gateway::Wiring& wiring) {
  for (const auto& link : wiring.links)
    lines_.push_back(link.wire == Wire::bytes ? std::make_unique<Line>() : nullptr);
  wait_.reserve(1 + lines_.size());
}

void SerialLoop::listen(std::size_t link, int fd, int baud) {
  auto& line = *lines_[link];
  for (HeardBytes old; line.heard.pop(old);) {
  }
  line.fd = fd;
  line.baud = baud;
  line.hold.lend();
  wake_.notify();
}

bool SerialLoop::leave(std::size_t link) {
  if (lines_[link]->hold.take_back()) return true;
  wake_.notify();
  return false;
}

bool SerialLoop::take(std::size_t link, HeardBytes& heard) {
  return lines_[link]->heard.pop(heard);
}

void SerialLoop::run(const std::atomic<bool>& stop) {
  began_ = monotonic_now();
  while (!stop.load(std::memory_order_relaxed)) {
    take_orders();
    wait();
    turns_.fetch_add(1, std::memory_order_relaxed);
  }
  for (const auto& line : lines_)
    if (line && line->hold.holds()) line->hold.let_go();
}

void SerialLoop::take_orders() {
  for (const auto& line : lines_) {
    if (!line) continue;
    line->hold.obey();
    if (!line->hold.begin()) continue;
    line->waits = line->dead = line->behind = false;
    line->empty_at = began_;
  }
}

/// A line for whose words there is no room keeps them. Whether one that is behind has more is asked
/// at once: else nobody would know what of the next came meanwhile.
void SerialLoop::wait() {
  wait_.assign(1, {wake_.fd(), POLLIN, 0});
  timespec longest{0, static_cast<long>(kLookEach.count())};
  for (const auto& line : lines_) {
    if (!line) continue;
    if (line->waits) line->waits = !told(*line);
    if (!is_read(*line)) continue;
    wait_.push_back({line->fd, POLLIN, 0});
    if (line->behind) longest = {};
  }
  const int ready = ::ppoll(wait_.data(), wait_.size(), &longest, nullptr);
  const Time ended = monotonic_now();
  if (ready > 0 && wait_.front().revents != 0) wake_.clear();
  auto fd = wait_.cbegin() + 1;
  for (const auto& line : lines_) {
    if (!line || !is_read(*line)) continue;
    if (ready > 0 && (fd++)->revents != 0)
      hear(*line, ended);
    else if (!too_old({began_, ended}))
      found_empty(*line, ended);
  }
  began_ = ended;
}

void SerialLoop::found_empty(Line& line, Time at) {
  line.empty_at = at;
  line.behind = false;
}

void SerialLoop::hear(Line& line, Time ended) {
  auto& heard = line.untold;
  std::size_t size = 0;
  heard.error = link::read_serial(line.fd, heard.bytes, size);
  if (size == 0 && heard.error == 0) return;
  const Listened listened{line.empty_at, ended, size, from_s(kBitsPerByte / line.baud)};
  heard.first = first_came_in(listened);
  line.behind = too_old(listened);  // and then what is left is as old
  if (!line.behind) line.empty_at = ended;
  heard.size = static_cast<std::uint16_t>(line.behind ? 0 : size);
  heard.thrown_away = static_cast<std::uint16_t>(line.behind ? size : 0);
  line.dead = heard.error != 0;
  line.waits = !told(line);
}

bool SerialLoop::told(Line& line) {
  if (!line.heard.push(line.untold)) return false;
  ready_.notify();
  return true;
}

}  // namespace drover::runtime
