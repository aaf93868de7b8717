// An inertial sensor's driver and its twin on one serial line: time, speeds and unplugging.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "drover/registry.h"
#include "drover/twin.h"
#include "support/allocation_counter.h"

namespace drover::test {

/// Ticks of 5 ms. Bytes at another speed than the other side's are noise, both ways.
class ImuBench {
 public:
  ImuBench(Made made_driver, std::unique_ptr<ImuTwin> made_twin, std::uint32_t baud)
      : made(std::move(made_driver)),
        driver(made.device.get()),
        twin(std::move(made_twin)),
        host_baud(baud) {
    truth.specific_force_mps2 = {0, 0, 9.80665};
    driver->on_link_up(now);
  }

  void run(Duration time) {
    for (const Time end = now + time; now < end;) step();
  }
  void step() {
    now += std::chrono::milliseconds(5);
    if (reopen_at != kNever && now >= reopen_at) {
      reopen_at = kNever;
      driver->on_link_up(now);
    }
    listen();
    out.clear();
    AllocationCounter counter;
    driver->on_tick(now, out);
    allocations += counter.count();
    take();
  }
  /// The cable, with the sensor's supply in it.
  void unplug() { plugged = false; }
  void plug() {
    plugged = true;
    (void)twin->set_state("restart", now);
    driver->on_link_up(now);
  }

  Made made;
  Device* driver;
  std::unique_ptr<ImuTwin> twin;
  std::uint32_t host_baud;
  ImuTruth truth;
  Time now{std::chrono::seconds(100)};
  bool plugged = true;
  Time reopen_at = kNever;
  DriverOut out;
  std::vector<std::uint8_t> sent;     ///< by the driver
  std::vector<std::uint32_t> speeds;  ///< that the driver asked for
  std::vector<Measurement> heard;
  ImuSample sample;  ///< the latest
  std::uint64_t samples = 0;
  std::uint64_t overflows = 0;
  std::uint64_t allocations = 0;

 private:
  bool line_is_good() const { return twin->baud() == host_baud; }
  std::uint8_t noise() {
    noise_ = noise_ * 1664525U + 1013904223U;
    return static_cast<std::uint8_t>(noise_ >> 24U);
  }
  void listen() {
    std::array<char, 2048> said{};
    const std::size_t size = twin->on_tick(now, truth, said);
    if (!plugged || reopen_at != kNever) return;
    std::array<std::uint8_t, 2048> bytes{};
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = line_is_good() ? static_cast<std::uint8_t>(said[i]) : noise();
    const Duration byte_time = std::chrono::nanoseconds(10'000'000'000 / host_baud);
    for (std::size_t at = 0; at < size; at += 64) {
      out.clear();
      AllocationCounter counter;
      made.bytes->on_bytes({bytes.data() + at, std::min<std::size_t>(64, size - at)},
                           now + byte_time * static_cast<long>(at), out);
      allocations += counter.count();
      take();
    }
  }
  void take() {
    overflows += out.overflows;
    for (const Measurement& m : out.measurements) {
      heard.push_back(m);
      if (const auto* value = std::get_if<ImuSample>(&m.value)) {
        sample = *value;
        ++samples;
      }
    }
    if (!out.bytes.empty()) {
      sent.insert(sent.end(), out.bytes.begin(), out.bytes.end());
      std::vector<std::uint8_t> arriving(out.bytes.begin(), out.bytes.end());
      for (auto& byte : arriving)
        if (!line_is_good()) byte = noise();
      if (plugged) twin->on_bytes(arriving, now);
    }
    if (out.reopen_baud != 0) {
      host_baud = out.reopen_baud;
      speeds.push_back(host_baud);
      reopen_at = now + std::chrono::milliseconds(50);
    }
  }

  std::uint32_t noise_ = 1;
};

}  // namespace drover::test
