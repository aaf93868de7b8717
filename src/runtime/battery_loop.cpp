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

link::ModbusSettings link_settings(const config::LinkConfig& link) {
  link::ModbusSettings settings;
  settings.port = link.modbus;
  settings.baud = link.baud;
  settings.parity = link.parity == "even" ? 'E' : link.parity == "odd" ? 'O' : 'N';
  return settings;
}

}  // namespace

BatteryLoop::BatteryLoop(const config::DroverConfig& config, const gateway::Wiring& wiring,
                         gateway::LinkId link, BatteryExchange& exchange)
    : exchange_(exchange),
      link_id_(link),
      name_(wiring.links[link].name),
      settings_(link_settings(config.links[wiring.links[link].place])) {
  for (const gateway::SlotId id : wiring.links[link].slots) {
    const auto& slot = wiring.slots[id];
    const auto& device = config.devices[slot.place];
    Unit unit;
    unit.slot = id;
    unit.name = slot.name;
    unit.period = from_s(device.period_s);
    unit.modbus = {static_cast<std::uint8_t>(device.unit), device.registers.gap_s,
                   device.registers.reply_s};
    const auto blocks = slot.made.registers->blocks();
    unit.blocks.assign(blocks.begin(), blocks.end());
    units_.push_back(std::move(unit));
  }
}

Time BatteryLoop::due(const Unit& unit) const {
  return std::max(unit.next_round, link_->ready_at(unit.modbus));
}

/// Who waits longest; so one that is silent and one that answers have their turns.
BatteryLoop::Unit& BatteryLoop::next_unit() {
  return *std::min_element(units_.begin(), units_.end(),
                           [this](const Unit& a, const Unit& b) { return due(a) < due(b); });
}

void BatteryLoop::run(const std::atomic<bool>& stop) {
  publish();
  while (!stop.load(std::memory_order_relaxed)) {
    Time now = monotonic_now();
    if (!link_ && retry_.due(now)) open(now);
    if (link_)
      if (Unit& unit = next_unit(); now >= due(unit)) ask(unit, now);
    now = monotonic_now();
    publish();
    turns_.fetch_add(1, std::memory_order_relaxed);
    sleep_until(link_ ? due(next_unit()) : retry_.next(), now);
  }
  link_.reset();
}

void BatteryLoop::open(Time now) {
  auto opened = link::open_modbus(settings_, &monotonic_now);
  now = monotonic_now();
  if (!opened.link) {
    tell_lost(now);
    return lose(opened.problem, now);
  }
  link_ = std::move(opened.link);
  retry_.succeeded();
  if (!problem_.empty()) log(LogLevel::info, said(name_, settings_.port + " is open"));
  problem_.clear();
  for (Unit& unit : units_) {
    unit.block = 0;
    unit.next_round = now;
  }
  tell({now, gateway::LinkUp{link_id_}});
}

std::string BatteryLoop::said(const Name& name, const std::string& text) const {
  return std::string(name) + ": " + text;
}

void BatteryLoop::tell_lost(Time now) {
  for (const Unit& unit : units_)
    tell({now, gateway::RegistersFailed{unit.slot, 0, RegisterFailure::link, 0}});
}

void BatteryLoop::lose(const std::string& why, Time now) {
  if (problem_.view() != why) log(LogLevel::warning, said(name_, why));
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
void BatteryLoop::ask(Unit& unit, Time now) {
  if (unit.block == 0) unit.next_round = now;
  const RegisterBlock& block = unit.blocks[unit.block];
  gateway::RegistersRead read;
  read.slot = unit.slot;
  read.block = static_cast<std::uint8_t>(unit.block);
  read.words.resize(block.count);
  const auto result = link_->read(unit.modbus, block, read.words);
  now = monotonic_now();
  if (result.good) {
    tell({now, read});
    if (++unit.block == unit.blocks.size()) {
      if (!std::exchange(unit.answers, true)) log(LogLevel::info, said(unit.name, "answers"));
      unit.block = 0;
      unit.next_round += unit.period;
    }
    return;
  }
  unit.block = 0;
  unit.next_round = now + unit.period;
  if (result.failure == RegisterFailure::link) {
    tell_lost(now);
    return lose(settings_.port + ": lost (" + std::strerror(link_->error()) + ")", now);
  }
  tell({now, gateway::RegistersFailed{unit.slot, read.block, result.failure, result.exception}});
}

/// What finds the ring full is missed like an answer that never came: the driver's data grow old.
void BatteryLoop::tell(const BatteryTold& told) {
  dropped_ += exchange_.told.push(told) ? 0 : 1;
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
    tell_lost(then);
    lose(settings_.port + ": lost (" + std::strerror(link_->error()) + ")", then);
  }
}

std::vector<std::unique_ptr<SlowLink>> slow_links(const config::DroverConfig& config,
                                                  const gateway::Wiring& wiring) {
  std::vector<std::unique_ptr<SlowLink>> all;
  for (std::size_t i = 0; i < wiring.links.size(); ++i) {
    if (wiring.links[i].wire != Wire::registers) continue;
    auto& link = *all.emplace_back(std::make_unique<SlowLink>());
    link.loop = std::make_unique<BatteryLoop>(config, wiring, static_cast<gateway::LinkId>(i),
                                              link.exchange);
  }
  return all;
}

}  // namespace drover::runtime
