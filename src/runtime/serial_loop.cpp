#include "runtime/serial_loop.h"

#include <algorithm>

#include "drover/driver.h"
#include "link/serial_link.h"
#include "runtime/clock.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// Its turns are counted: so often it takes one at the least.
constexpr Duration kLookEach = 50ms;

}  // namespace

Time first_came_in(Time last, std::size_t size, Duration byte_time) {
  const auto before_last = static_cast<std::int64_t>(size) - 1;
  return last - byte_time * std::max<std::int64_t>(before_last, 0);
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
    line->waits = line->dead = false;
  }
}

/// A line for whose words there is no room keeps them.
void SerialLoop::wait() {
  wait_.assign(1, {wake_.fd(), POLLIN, 0});
  for (const auto& line : lines_) {
    if (!line) continue;
    if (line->waits) line->waits = !told(*line);
    if (is_read(*line)) wait_.push_back({line->fd, POLLIN, 0});
  }
  const timespec longest{0, static_cast<long>(kLookEach.count())};
  const int ready = ::ppoll(wait_.data(), wait_.size(), &longest, nullptr);
  const Time now = monotonic_now();
  if (ready <= 0) return;
  if (wait_.front().revents != 0) wake_.clear();
  auto fd = wait_.cbegin() + 1;
  for (const auto& line : lines_)
    if (line && is_read(*line) && (fd++)->revents != 0) hear(*line, now);
}

void SerialLoop::hear(Line& line, Time now) {
  auto& heard = line.untold;
  std::size_t size = 0;
  heard.error = link::read_serial(line.fd, heard.bytes, size);
  if (size == 0 && heard.error == 0) return;
  heard.size = static_cast<std::uint16_t>(size);
  heard.first = first_came_in(now, size, from_s(kBitsPerByte / line.baud));
  line.dead = heard.error != 0;
  line.waits = !told(line);
}

bool SerialLoop::told(Line& line) {
  if (!line.heard.push(line.untold)) return false;
  ready_.notify();
  return true;
}

}  // namespace drover::runtime
