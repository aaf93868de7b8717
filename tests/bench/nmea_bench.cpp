// The NMEA driver over a file, as a process that can be timed beside another decoder of the file.
//
//   bench_nmea --write FILE MB   what a receiver says at 10 Hz, until so many megabytes
//   bench_nmea FILE              decodes it: "positions velocities headings bad"
//   bench_nmea --floor FILE      only finds the ends of lines and adds up their checksums
//   bench_nmea --check           writes, decodes and compares a small one; no file
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/entry.h"
#include "drivers/nmea0183/twin.h"

namespace {

using namespace drover;

constexpr std::size_t kAtOnce = 4096;  // as the serial link reads at most

Options defaults() {
  Options options(kNmea0183Entry.options);
  for (const auto& spec : kNmea0183Entry.twin_options) options.set(spec.name, spec.default_value);
  return options;
}

/// A robot that drives around on a meadow.
std::string receiver_says(std::size_t bytes) {
  nmea0183::Nmea0183Twin twin(defaults(), 1);
  GnssTruth truth{.latitude_deg = 48.2, .longitude_deg = 11.3, .altitude_m = 480};
  std::string said;
  std::array<char, 4096> epoch{};
  for (Time now{}; said.size() < bytes; now += std::chrono::milliseconds(50)) {
    truth.latitude_deg += 1e-7;
    truth.heading_deg = truth.course_deg = truth.heading_deg < 359 ? truth.heading_deg + 0.3 : 0;
    truth.speed_mps = 0.5;
    said.append(epoch.data(), twin.on_tick(now, truth, epoch));
  }
  return said;
}

struct Counts {
  std::size_t positions = 0;
  std::size_t velocities = 0;
  std::size_t headings = 0;
  std::uint64_t bad = 0;
};

/// Piece by piece, as a decoder does that sits at a line.
Counts decode(std::istream& text) {
  nmea0183::Nmea0183Driver driver(defaults());
  Counts counts;
  DriverOut out;
  Time now{};
  driver.on_link_up(now);
  for (std::array<char, kAtOnce> piece{}; text;) {
    text.read(piece.data(), piece.size());
    const auto size = static_cast<std::size_t>(text.gcount());
    // As fast as the line would bring them.
    now += std::chrono::microseconds(87 * size);
    driver.on_bytes({reinterpret_cast<const std::uint8_t*>(piece.data()), size}, now, out);
    for (const auto& measurement : out.measurements) {
      counts.positions += std::holds_alternative<GnssPosition>(measurement.value) ? 1 : 0;
      counts.velocities += std::holds_alternative<GnssVelocity>(measurement.value) ? 1 : 0;
      counts.headings += std::holds_alternative<GnssHeading>(measurement.value) ? 1 : 0;
    }
    out.clear();
  }
  counts.bad = driver.health(now).bad;
  return counts;
}

std::size_t floor_of(std::istream& text) {
  std::size_t lines = 0;
  unsigned sum = 0;
  for (std::array<char, kAtOnce> piece{}; text;) {
    text.read(piece.data(), piece.size());
    for (const char c : std::string_view(piece.data(), static_cast<std::size_t>(text.gcount()))) {
      if (c == '\n') {
        ++lines;
      } else {
        sum ^= static_cast<unsigned char>(c);
      }
    }
  }
  return lines + (sum > 255 ? 1 : 0);
}

std::ifstream opened(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (file) return file;
  std::cerr << path << " cannot be read\n";
  std::exit(2);
}

int check() {
  const auto said = receiver_says(100'000);
  std::istringstream text(said);
  const auto counts = decode(text);
  const bool good = counts.positions > 200 && counts.velocities == counts.positions &&
                    counts.headings == counts.positions && counts.bad == 0;
  std::printf("%zu positions in %zu bytes: %s\n", counts.positions, said.size(),
              good ? "good" : "BAD");
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == "--check" && argc == 2) return check();
  if (first == "--write" && argc == 4) {
    std::ofstream(argv[2], std::ios::binary) << receiver_says(std::stoul(argv[3]) * 1'000'000);
    return 0;
  }
  if (first == "--floor" && argc == 3) {
    auto file = opened(argv[2]);
    std::printf("%zu lines\n", floor_of(file));
    return 0;
  }
  if (argc != 2) {
    std::cerr << "bench_nmea [--write FILE MB | --floor FILE | --check | FILE]\n";
    return 2;
  }
  auto file = opened(argv[1]);
  const auto counts = decode(file);
  std::printf("%zu positions, %zu velocities, %zu headings, %llu bad\n", counts.positions,
              counts.velocities, counts.headings, static_cast<unsigned long long>(counts.bad));
  return 0;
}
