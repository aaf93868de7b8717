#include "runtime/scan_loop.h"

#include <poll.h>

#include <algorithm>
#include <cstring>

#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/scene_settings.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// Bytes are let come together: a wake-up for each packet would be 375 a second.
constexpr Duration kListenEach = 10ms;
constexpr Duration kPublishEach = 100ms;
/// All that the kernel keeps of a line that was not read for long.
constexpr std::size_t kMostWaiting = 65536;
/// Of so many a face drops no turn.
constexpr std::size_t kMostAtOnce = 4096;
/// Of a thread that says nothing new.
constexpr Duration kStandsStill = 1s;

Made make_scanner(const config::DeviceConfig& device) {
  return find_driver(device.driver, SlotKind::scanner)
      ->make(device.options, config::context_of(device));
}

}  // namespace

ScanLoop::ScanLoop(const config::DroverConfig& config, const config::DeviceConfig& device,
                   ScanExchange& exchange)
    : exchange_(exchange),
      name_(device.name),
      link_name_(config.links[device.link_index].name),
      settings_{config.links[device.link_index].serial, config.links[device.link_index].baud},
      byte_time_(from_s(kBitsPerByte / settings_.baud)),
      made_(make_scanner(device)),
      field_(sensor_field(config, made_.scans->mount())),
      buffer_(kMostWaiting) {
  seen_.device = shown_.name = name_;
  publish(kNever);
}

void ScanLoop::run(const std::atomic<bool>& stop) {
  while (!stop.load(std::memory_order_relaxed)) {
    Time now = monotonic_now();
    if (!link_ && retry_.due(now)) open(now);
    if (link_) hear();
    now = monotonic_now();
    if (now >= next_publish_) publish(now);
    turns_.fetch_add(1, std::memory_order_relaxed);
    sleep(now);
  }
  link_.reset();
}

void ScanLoop::open(Time now) {
  auto opened = link::open_serial(settings_);
  now = monotonic_now();
  if (!opened.link) return lose(opened.problem, now);
  link_ = std::move(opened.link);
  retry_.succeeded();
  if (!problem_.empty())
    log(LogLevel::info, std::string(name_) + ": " + settings_.path + " is open");
  problem_.clear();
  made_.device->on_link_up(now);
  read_ = now;
}

void ScanLoop::lose(const std::string& why, Time now) {
  if (problem_.view() != why) log(LogLevel::warning, std::string(name_) + ": " + why);
  problem_.assign(why);
  link_.reset();
  retry_.tried(now);
  next_publish_ = kNever;  // at once
}

/// Everything that waits.
void ScanLoop::hear() {
  std::size_t size = 0;
  bool there = true;
  for (std::size_t part = 1; there && part > 0 && size < buffer_.size(); size += part)
    there = link_->read(std::span(buffer_).subspan(size), part);
  const Time now = monotonic_now();
  received_ += size;
  decode({buffer_.data(), size}, came_in({read_, now}, size, byte_time_));
  read_ = now;
  if (!there) lose(settings_.path + ": lost (" + std::strerror(link_->error()) + ")", now);
}

void ScanLoop::decode(std::span<const std::uint8_t> bytes, Time first) {
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), kMostAtOnce));
    out_.clear();
    made_.scans->on_bytes(part, first, out_);
    shown_.source.overflows += out_.overflows;
    for (const Scan& turn : out_.scans) take(turn);
    first += byte_time_ * static_cast<std::int64_t>(part.size());
    bytes = bytes.subspan(part.size());
  }
}

void ScanLoop::take(const Scan& turn) {
  seen_.begin = turn.begin;
  seen_.end = turn.end;
  seen_.field = scene::sensor::look(turn, made_.scans->mount(), field_);
  for (auto* const reader : {&exchange_.turn, &exchange_.shown_turn}) {
    reader->back() = {name_, made_.scans->mount(), turn};
    reader->publish();
  }
  ++shown_.source.samples;
  shown_.time = turn.end;
  shown_.turn_Hz = turn.turn_Hz;
  shown_.points = static_cast<std::uint32_t>(turn.points.size());
  shown_.returns = static_cast<std::uint32_t>(
      std::count_if(turn.points.begin(), turn.points.end(),
                    [](const ScanPoint& point) { return point.range_m > 0; }));
  show_nearest(turn, made_.scans->mount().yaw_rad, shown_);
  next_publish_ = kNever;  // at once
}

/// Without a line nothing is fresh, however young.
SourceHealth ScanLoop::health(Time now) const {
  SourceHealth health = made_.device->health(now);
  if (link_) return health;
  if (health.state == SourceState::fresh) health.state = SourceState::stale;
  health.reason = problem_;
  return health;
}

void ScanLoop::publish(Time now) {
  next_publish_ = now + kPublishEach;
  const SourceHealth is = health(now);
  seen_.state = is.state;
  seen_.reason = is.reason;
  exchange_.seen.back() = seen_;
  exchange_.seen.publish();
  shown_.health = is.state;
  shown_.source.reason = is.reason;
  shown_.source.bad = is.bad;
  auto& told = exchange_.told.back();
  told.scanner = shown_;
  told.link = {};
  told.link.name = link_name_;
  told.link.up = link_ != nullptr;
  told.link.reason = problem_;
  told.link.received = received_;
  told.at = now;
  exchange_.told.publish();
}

void ScanLoop::sleep(Time now) {
  const Time due = link_ ? now + kListenEach : std::min(retry_.next(), next_publish_);
  const Duration left = std::clamp(due - now, Duration{0}, kPublishEach);
  const timespec wait{0, static_cast<long>(left.count())};
  pollfd woken{wake_.fd(), POLLIN, 0};
  if (::ppoll(&woken, 1, &wait, nullptr) > 0) wake_.clear();
}

std::vector<std::unique_ptr<ScanLink>> scan_links(const config::DroverConfig& config) {
  std::vector<std::unique_ptr<ScanLink>> all;
  for (const auto& device : config.devices) {
    if (device.kind != SlotKind::scanner) continue;
    auto& link = *all.emplace_back(std::make_unique<ScanLink>());
    link.loop = std::make_unique<ScanLoop>(config, device, link.exchange);
  }
  return all;
}

Time came_in(const ReadTimes& read, std::size_t size, Duration byte_time) {
  return std::min(read.before, read.now - byte_time * static_cast<std::int64_t>(size));
}

void show_nearest(const Scan& turn, double yaw_rad, ScannerSnapshot& shown) {
  shown.nearest_m = kAbsent;
  shown.nearest_deg = kAbsent;
  for (const ScanPoint& point : turn.points) {
    if (!(point.range_m > 0) || point.range_m >= shown.nearest_m) continue;
    shown.nearest_m = point.range_m;
    shown.nearest_deg = to_deg(wrap_rad(point.bearing_rad + yaw_rad));
  }
}

ScannerSnapshot as_shown(const ScanTold& told, Time now) {
  ScannerSnapshot shown = told.scanner;
  if (told.at == kNever || now - told.at <= kStandsStill) return shown;
  if (shown.health == SourceState::fresh) shown.health = SourceState::stale;
  shown.source.reason = "not looked at: its thread stands still";
  return shown;
}

}  // namespace drover::runtime
