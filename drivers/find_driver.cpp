// Looks into the table of drivers.
#include <algorithm>
#include <array>
#include <string>

#include "drover/registry.h"

namespace drover {
namespace {

/// Asked for, and nobody has written a driver: README.md tells how.
constexpr std::array<std::string_view, 18> kSpokenByNone{
    "vesc",    "bunker", "tracer", "ranger",   "moteus",  "cybergear",
    "jbd",     "hesai",  "livox",  "velodyne", "slamtec", "ouster",
    "rplidar", "bno055", "bno08",  "mpu6050",  "mpu9250", "icm20948"};

/// As products are written in the entries: "ZED-F9P" is zedf9p.
std::string plain(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

/// A maker's two letters stand in many other words.
bool names(std::string_view written, std::string_view known) {
  constexpr std::size_t kShort = 2;
  return known.size() <= kShort ? written == known : written.find(known) != std::string_view::npos;
}

}  // namespace

const DriverEntry* find_driver(std::string_view name) {
  for (const DriverEntry& entry : driver_registry())
    if (entry.name == name) return &entry;
  return nullptr;
}

const DriverEntry* find_driver(std::string_view name, SlotKind kind) {
  const DriverEntry* const entry = find_driver(name);
  return entry != nullptr && entry->kind == kind ? entry : nullptr;
}

const DriverEntry* find_by_product(std::string_view product) {
  const std::string written = plain(product);
  for (const DriverEntry& entry : driver_registry())
    for (const std::string_view known : entry.products)
      if (names(written, known)) return &entry;
  return nullptr;
}

bool is_spoken_by_none(std::string_view product) {
  const std::string written = plain(product);
  return std::any_of(kSpokenByNone.begin(), kSpokenByNone.end(),
                     [&](std::string_view known) { return names(written, known); });
}

}  // namespace drover
