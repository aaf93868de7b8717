#include "sim/robot/simulator.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace drover::sim {
namespace {

constexpr std::uint64_t kMaxCatchUp = 20;  // ticks
constexpr Duration kFlushPeriod = std::chrono::seconds(1);

Duration read_clock(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec);
}

timespec to_timespec(Duration d) {
  return {static_cast<time_t>(d.count() / 1'000'000'000), d.count() % 1'000'000'000};
}

}  // namespace

Simulator::~Simulator() {
  ::unlink((settings_.run_folder + "/ready").c_str());
}

void Simulator::run() {
  write_lines();
  measure_clocks();
  const auto now = read_clock(CLOCK_MONOTONIC);
  start_ = Time{(now / kTick + 1) * kTick};
  previous_ = start_ - kTick;
  next_truth_ = next_flush_ = start_;
  itimerspec times{to_timespec(kTick), to_timespec(start_.time_since_epoch())};
  ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &times, nullptr);

  std::printf("drover-sim ready: %s, seed %llu, %zu drives, run folder %s\n",
              robot_.scenario().name.c_str(), static_cast<unsigned long long>(settings_.seed),
              robot_.scenario().drives.size(), settings_.run_folder.c_str());
  std::fflush(stdout);
  std::ofstream(settings_.run_folder + "/ready") << ::getpid() << "\n";

  Time next = start_;
  while (!quit_) {
    on_events(-1);
    if (expired_ > kMaxCatchUp) {
      left_out_ += expired_ - kMaxCatchUp;
      next += kTick * static_cast<std::int64_t>(expired_ - kMaxCatchUp);
      expired_ = kMaxCatchUp;
    }
    for (; expired_ > 0 && !quit_; --expired_, next += kTick) tick(next);
  }
  can_log_.flush();
  serial_log_.flush();
  truth_log_.flush();
  object_log_.flush();
}

void Simulator::on_events(int timeout_ms) {
  std::array<epoll_event, 16> events{};
  const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), timeout_ms);
  for (int i = 0; i < n; ++i) {
    const int fd = events[static_cast<std::size_t>(i)].data.fd;
    if (fd == timer_.get()) {
      std::uint64_t expirations = 0;
      if (::read(fd, &expirations, sizeof expirations) == sizeof expirations)
        expired_ += expirations;
    } else if (fd == signals_.get()) {
      quit_ = true;
    } else if (!drain_bus(fd)) {
      control_->on_event(fd, [this](std::string_view text) { return command(text); });
    }
  }
}

bool Simulator::drain_bus(int fd) {
  for (const auto& bus : buses_) {
    if (bus->descriptor() != fd) continue;
    bus->drain();
    return true;
  }
  return false;
}

void Simulator::tick(Time now) {
  ++ticks_;
  const auto& events = robot_.scenario().events;
  while (next_event_ < events.size() && now - start_ >= events[next_event_].at) {
    const auto answer = command(events[next_event_].command);
    if (answer.starts_with("error"))
      std::fprintf(stderr, "drover-sim: event '%s': %s\n", events[next_event_].command.c_str(),
                   answer.c_str());
    ++next_event_;
  }
  if (relay_) robot_.set_relay(relay_->closed());
  exchange_can(now);
  hear_drives(now);
  robot_.step(now);
  send_can(now);
  write_lines();
  if (outputs_) outputs_->sample(now);
  exchange_serial(now);
  for (const auto& line : batteries_) line->pump(now, kTick);
  keep_records(now);
  previous_ = now;
}

void Simulator::exchange_can(Time now) {
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    received_.clear();
    buses_[i]->receive({previous_, now, wall_minus_monotonic_}, received_);
    frames_in_ += received_.size();
    for (const auto& received : received_) {
      can_log_.write(received.received, robot_.scenario().buses[i].name, received.frame);
      robot_.on_frame(i, received.frame, now);
    }
  }
}

void Simulator::send_can(Time now) {
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    const auto& frames = robot_.frames(i);
    if (frames.empty()) continue;
    buses_[i]->send(frames);
    frames_out_ += frames.size();
    for (const auto& frame : frames) can_log_.write(now, robot_.scenario().buses[i].name, frame);
  }
}

void Simulator::hear_drives(Time now) {
  for (std::size_t i = 0; i < drive_lines_.size(); ++i) {
    if (!drive_lines_[i]) continue;
    drive_lines_[i]->listen(kTick);
    robot_.on_drive_bytes(i, drive_lines_[i]->heard(), now);
    serial_log_.write(now, robot_.scenario().drives[i].serial->port, drive_lines_[i]->heard());
  }
}

void Simulator::exchange_serial(Time now) {
  for (std::size_t i = 0; i < drive_lines_.size(); ++i)
    if (drive_lines_[i]) drive_lines_[i]->pump(robot_.drive_bytes(i), kTick);
  // What is written to a receiver does not concern this one.
  if (gnss_) gnss_->pump(robot_.gnss_bytes(), kTick);
  if (lidar_) lidar_->pump(robot_.lidar_bytes(), kTick);
  for (std::size_t i = 0; i < more_lines_.size(); ++i) {
    if (!more_lines_[i]) continue;
    if (const int baud = robot_.more().baud(i); baud != 0) more_lines_[i]->set_baud(baud);
    more_lines_[i]->pump(robot_.more().bytes(i), kTick);
    robot_.more().on_bytes(i, more_lines_[i]->heard(), now);
  }
  if (!imu_) return;
  imu_->set_baud(robot_.imu_baud());
  imu_->pump(robot_.imu_bytes(), kTick);
  robot_.on_imu_bytes(imu_->heard(), now);
}

void Simulator::write_lines() {
  for (std::size_t i = 0; i < kLineNames; ++i) {
    const auto line = static_cast<LineName>(i);
    lines_.set(line, robot_.line_high(line));
  }
}

void Simulator::keep_records(Time now) {
  if (now >= next_truth_) {
    truth_log_.write(robot_.truth());
    next_truth_ = now + robot_.scenario().truth_period;
  }
  if (robot_.has_objects()) object_log_.append(robot_.take_object_lines());
  if (now >= next_flush_) {
    can_log_.flush();
    serial_log_.flush();
    truth_log_.flush();
    object_log_.flush();
    if (outputs_) outputs_->flush();
    measure_clocks();
    next_flush_ = now + kFlushPeriod;
  }
}

// The kernel stamps CAN frames with the wall clock.
void Simulator::measure_clocks() {
  const auto before = read_clock(CLOCK_MONOTONIC);
  const auto wall = read_clock(CLOCK_REALTIME);
  const auto after = read_clock(CLOCK_MONOTONIC);
  wall_minus_monotonic_ = wall - (before + (after - before) / 2);
}

std::string Simulator::summary() const {
  std::uint64_t can_dropped = 0;
  for (const auto& bus : buses_) can_dropped += bus->dropped();
  std::array<char, 256> text{};
  std::uint64_t serial_dropped = (gnss_ ? gnss_->dropped() : 0) + (imu_ ? imu_->dropped() : 0);
  serial_dropped += lidar_ ? lidar_->dropped() : 0;
  for (const auto& line : more_lines_) serial_dropped += line ? line->dropped() : 0;
  for (const auto& line : drive_lines_) serial_dropped += line ? line->dropped() : 0;
  const int n = std::snprintf(
      text.data(), text.size(),
      "%llu ticks (%llu left out), CAN frames %llu in, %llu out, %llu dropped, serial bytes "
      "dropped %llu",
      static_cast<unsigned long long>(ticks_), static_cast<unsigned long long>(left_out_),
      static_cast<unsigned long long>(frames_in_), static_cast<unsigned long long>(frames_out_),
      static_cast<unsigned long long>(can_dropped),
      static_cast<unsigned long long>(serial_dropped));
  return {text.data(), static_cast<std::size_t>(n)};
}

}  // namespace drover::sim
