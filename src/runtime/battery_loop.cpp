#include "runtime/battery_loop.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "runtime/clock.h"
#include "runtime/log.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// The longest sleep: the thread shows that it lives.
constexpr Duration kLongestSleep = 1s;

link::ModbusSettings link_settings(const config::LinkConfig& link,
                                   const config::DeviceConfig& device) {
  link::ModbusSettings settings;
  settings.port = link.modbus;
  settings.baud = link.baud;
  settings.parity = link.parity == "even" ? 'E' : link.parity == "odd" ? 'O' : 'N';
  settings.unit = static_cast<std::uint8_t>(device.unit);
  settings.gap_s = device.registers.gap_s;
  settings.reply_s = device.registers.reply_s;
  return settings;
}

const config::DeviceConfig& device_of(const config::DroverConfig& config,
                                      const gateway::Slot& slot) {
  return config.devices[slot.place];
}

}  // namespace

BatteryLoop::BatteryLoop(const config::DroverConfig& config, const gateway::Wiring& wiring,
                         gateway::SlotId slot, BatteryExchange& exchange)
    : exchange_(exchange),
      slot_(slot),
      link_id_(wiring.slots[slot].link),
      name_(wiring.links[link_id_].name),
      period_(from_s(device_of(config, wiring.slots[slot]).period_s)),
      settings_(link_settings(config.links[wiring.links[link_id_].place],
                              device_of(config, wiring.slots[slot]))) {
  const auto blocks = wiring.slots[slot_].made.registers->blocks();
  blocks_.assign(blocks.begin(), blocks.end());
}

void BatteryLoop::run(const std::atomic<bool>& stop) {
  publish();
  while (!stop.load(std::memory_order_relaxed)) {
    Time now = monotonic_now();
    if (!link_ && retry_.due(now)) open(now);
    if (link_ && now >= std::max(next_round_, link_->ready_at())) ask(now);
    now = monotonic_now();
    publish();
    turns_.fetch_add(1, std::memory_order_relaxed);
    sleep_until(link_ ? std::max(next_round_, link_->ready_at()) : retry_.next(), now);
  }
  link_.reset();
}

void BatteryLoop::open(Time now) {
  auto opened = link::open_modbus(settings_, &monotonic_now);
  now = monotonic_now();
  if (!opened.link) {
    tell(gateway::RegistersFailed{slot_, 0, RegisterFailure::link, 0}, now);
    return lose(opened.problem, now);
  }
  link_ = std::move(opened.link);
  retry_.succeeded();
  if (!problem_.empty()) log(LogLevel::info, said(settings_.port + " is open"));
  problem_.clear();
  block_ = 0;
  next_round_ = now;
  tell(gateway::LinkUp{link_id_}, now);
}

std::string BatteryLoop::said(const std::string& text) const {
  return std::string(name_) + ": " + text;
}

void BatteryLoop::lose(const std::string& why, Time now) {
  if (problem_.view() != why) log(LogLevel::warning, said(why));
  problem_.assign(why);
  if (link_) {
    const auto& last = link_->counters();
    closed_.requests += last.requests;
    closed_.answers += last.answers;
    closed_.late_bytes += last.late_bytes;
  }
  link_.reset();
  retry_.tried(now);
}

/// One block; the round goes on at the next turn.
void BatteryLoop::ask(Time now) {
  if (block_ == 0) next_round_ = now;
  const RegisterBlock& block = blocks_[block_];
  gateway::RegistersRead read;
  read.slot = slot_;
  read.block = static_cast<std::uint8_t>(block_);
  read.words.resize(block.count);
  const auto result = link_->read(block, read.words);
  now = monotonic_now();
  if (result.good) {
    tell(read, now);
    if (++block_ == blocks_.size()) {
      if (!std::exchange(answers_, true)) log(LogLevel::info, said("answers"));
      block_ = 0;
      next_round_ += period_;
    }
    return;
  }
  tell(gateway::RegistersFailed{slot_, read.block, result.failure, result.exception}, now);
  block_ = 0;
  next_round_ = now + period_;
  if (result.failure == RegisterFailure::link)
    lose(settings_.port + ": lost (" + std::strerror(link_->error()) + ")", now);
}

/// What finds the ring full is missed like an answer that never came: the driver's data grow old.
template <class What>
void BatteryLoop::tell(const What& what, Time at) {
  dropped_ += exchange_.told.push(BatteryTold{at, what}) ? 0 : 1;
}

void BatteryLoop::publish() {
  auto& link = exchange_.link.back();
  link.name = name_;
  link.up = link_ != nullptr;
  link.reason = problem_;
  link.sent = closed_.requests + (link_ ? link_->counters().requests : 0);
  link.received = closed_.answers + (link_ ? link_->counters().answers : 0);
  link.dropped = dropped_ + closed_.late_bytes + (link_ ? link_->counters().late_bytes : 0);
  exchange_.link.publish();
}

void BatteryLoop::sleep_until(Time due, Time now) {
  const Duration left = std::clamp(due - now, Duration{0}, kLongestSleep);
  const timespec wait{static_cast<time_t>(left / 1s), static_cast<long>((left % 1s).count())};
  pollfd fds[2] = {{wake_.fd(), POLLIN, 0}, {link_ ? link_->fd() : -1, POLLIN, 0}};
  if (::ppoll(fds, 2, &wait, nullptr) <= 0) return;
  if ((fds[0].revents & POLLIN) != 0) wake_.clear();
  if (link_ && fds[1].revents != 0 && !link_->drain()) {
    // Noticed at once: a device that stays open comes back under another name.
    const Time then = monotonic_now();
    tell(gateway::RegistersFailed{slot_, 0, RegisterFailure::link, 0}, then);
    lose(settings_.port + ": lost (" + std::strerror(link_->error()) + ")", then);
  }
}

}  // namespace drover::runtime
