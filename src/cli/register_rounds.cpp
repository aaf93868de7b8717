#include "cli/register_rounds.h"

#include <algorithm>
#include <cstdio>

#include "config/fields_map.h"

namespace drover::cli {

namespace {

bool has(const RegisterImage& image, std::uint8_t function, std::size_t address) {
  return address <= 0xFFFF && image.count({function, static_cast<std::uint16_t>(address)}) != 0;
}

/// How many neighbours of the field can be told: all that are fitted, or 0.
std::size_t held(const RegisterMap& map, const RegisterField& field, const RegisterImage& image) {
  std::size_t count = field.count;
  if (field.count_address) {
    if (!has(image, field.function, *field.count_address)) return 0;
    count = std::min<std::size_t>(count, image.at({field.function, *field.count_address}));
  }
  for (std::size_t i = 0; i < count * registers_of(field.type); ++i)
    if (!has(image, field.function, field.address + i * map.stride)) return 0;
  return count;
}

}  // namespace

RegisterMap part_of(const RegisterMap& map, const RegisterImage& image) {
  RegisterMap part = map;
  part.fields.clear();
  for (RegisterField field : map.fields) {
    const auto count = held(map, field, image);
    if (count == 0) continue;
    field.count = static_cast<std::uint16_t>(count);
    part.fields.push_back(std::move(field));
  }
  std::erase_if(part.alarms, [&](const RegisterAlarm& alarm) {
    return !has(image, alarm.function, alarm.address);
  });
  return part;
}

RoundDecoder::RoundDecoder(Make make, const RegisterMap& map)
    : make_(std::move(make)), map_(map), seen_(map.fields.size()) {}

const Device* RoundDecoder::decode(const RegisterImage& image, Time now, DriverOut& out) {
  Held kept;
  for (std::size_t i = 0; i < map_.fields.size(); ++i) {
    kept.push_back(held(map_, map_.fields[i], image));
    if (kept.back() > 0) seen_[i] = true;
  }
  for (const auto& alarm : map_.alarms) kept.push_back(has(image, alarm.function, alarm.address));
  if (std::all_of(kept.begin(), kept.end(), [](std::size_t count) { return count == 0; }))
    return nullptr;
  auto& driver = drivers_[kept];
  if (!driver.device) {
    driver = make_(part_of(map_, image));
    driver.device->on_link_up(now);
  }
  last_ = driver.device.get();
  const auto blocks = driver.registers->blocks();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<std::uint16_t> words;
    for (std::size_t i = 0; i < blocks[b].count; ++i) {
      const auto at = image.find(
          {blocks[b].function, static_cast<std::uint16_t>(blocks[b].address + i * map_.stride)});
      words.push_back(at != image.end() ? at->second : 0);  // a gap, which nobody reads
    }
    driver.registers->on_registers(b, words, now, out);
  }
  return last_;
}

std::string RoundDecoder::missing() const {
  std::string text;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i]) continue;
    char at[24];
    std::snprintf(at, sizeof at, " (0x%04X)", static_cast<unsigned>(map_.fields[i].address));
    text += (text.empty() ? "" : ", ") +
            config::kMapFields[static_cast<std::size_t>(map_.fields[i].field)] + at;
  }
  return text;
}

std::uint64_t RoundDecoder::bad(Time now) const {
  std::uint64_t bad = 0;
  for (const auto& [kept, driver] : drivers_) bad += driver.device->health(now).bad;
  return bad;
}

std::string RoundDecoder::reason(Time now) const {
  return last_ != nullptr ? std::string(last_->health(now).reason.view()) : std::string();
}

}  // namespace drover::cli
