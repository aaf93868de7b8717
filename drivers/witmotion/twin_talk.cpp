// What the simulated sensor says and what it obeys.
#include <chrono>

#include "drivers/witmotion/twin.h"
#include "drover/bytes.h"

namespace drover::witmotion {
namespace {

constexpr Duration kUnlocked = std::chrono::seconds(10);
constexpr Duration kBusy = std::chrono::milliseconds(50);
constexpr Duration kBusySaving = std::chrono::milliseconds(500);
constexpr auto kFirstDay = std::chrono::sys_days{std::chrono::year{2026} / 6 / 1};

}  // namespace

void WitmotionTwin::say(FrameType type, std::array<std::int16_t, 4> words) {
  std::array<std::uint8_t, kFrameSize> frame{kHeader, static_cast<std::uint8_t>(type)};
  for (std::size_t i = 0; i < words.size(); ++i) store_le(frame, 2 + 2 * i, words[i]);
  frame.back() = checksum({frame.data(), kFrameSize - 1});
  said_.insert(said_.end(), frame.begin(), frame.end());
}

void WitmotionTwin::say_combined() {
  said_.push_back(kHeader);
  said_.push_back(static_cast<std::uint8_t>(FrameType::combined));
  for (const Words* words : {&readings_.acceleration, &readings_.rate, &readings_.angles}) {
    for (const std::int16_t word : *words) {
      said_.push_back(low_byte(static_cast<std::uint16_t>(word)));
      said_.push_back(high_byte(static_cast<std::uint16_t>(word)));
    }
  }
}

void WitmotionTwin::say_date(Time now) {
  using namespace std::chrono;
  const auto since = duration_cast<milliseconds>(now - start_);
  const auto days_on = floor<days>(since);
  const year_month_day date{kFirstDay + days_on};
  const hh_mm_ss time{since - days_on};
  const auto pair = [](auto a, auto b) {
    return static_cast<std::int16_t>(static_cast<unsigned>(a) | static_cast<unsigned>(b) << 8U);
  };
  say(FrameType::clock,
      {pair(static_cast<int>(date.year()) - 2000, static_cast<unsigned>(date.month())),
       pair(static_cast<unsigned>(date.day()), time.hours().count()),
       pair(time.minutes().count(), time.seconds().count()),
       static_cast<std::int16_t>(time.subseconds().count())});
}

void WitmotionTwin::say_cycle(Time now) {
  if (combined_) return say_combined();
  const auto& r = readings_;
  const unsigned content = active_.content;
  const auto with = [](const Words& words, std::int16_t last) {
    return std::array<std::int16_t, 4>{words[0], words[1], words[2], last};
  };
  if ((content & kClock) != 0) say_date(now);
  if ((content & kAcceleration) != 0)
    say(FrameType::acceleration, with(r.acceleration, r.temperature));
  if ((content & kAngularRate) != 0) say(FrameType::angular_rate, with(r.rate, r.temperature));
  if ((content & kAngles) != 0) say(FrameType::angles, with(r.angles, 500));
  if ((content & kMagneticField) != 0) say(FrameType::magnetic_field, with(r.field, r.temperature));
  if ((content & kQuaternion) != 0) say(FrameType::quaternion, r.quaternion);
}

std::uint16_t* WitmotionTwin::setting(std::uint8_t address) {
  switch (static_cast<Register>(address)) {
    case Register::content: return &active_.content;
    case Register::rate: return &active_.rate;
    case Register::baud: return &active_.baud;
    case Register::bandwidth: return &active_.bandwidth;
    case Register::algorithm: return &active_.algorithm;
    default: return nullptr;
  }
}

void WitmotionTwin::answer(std::uint8_t first) {
  std::array<std::int16_t, 4> words{};
  for (std::size_t i = 0; i < words.size(); ++i)
    if (const auto* value = setting(static_cast<std::uint8_t>(first + i)))
      words[i] = static_cast<std::int16_t>(*value);
  say(FrameType::registers, words);
}

void WitmotionTwin::on_bytes(std::span<const std::uint8_t> bytes, Time now) {
  if (fault_ == Fault::silent) return;
  for (const std::uint8_t byte : bytes) {
    incoming_[incoming_size_++] = byte;
    if (incoming_[0] != 0xFF || (incoming_size_ == 2 && byte != 0xAA)) {
      incoming_size_ = byte == 0xFF ? 1 : 0;
      incoming_[0] = byte;
    } else if (incoming_size_ == incoming_.size()) {
      incoming_size_ = 0;
      obey(incoming_, now);
    }
  }
}

void WitmotionTwin::obey(const Command& command, Time now) {
  if (now < busy_until_ || combined_) return;
  busy_until_ = now + kBusy;
  const auto value = load_le<std::uint16_t>(command, 3);
  if (command[2] == static_cast<std::uint8_t>(Register::read)) return answer(low_byte(value));
  if (command[2] == static_cast<std::uint8_t>(Register::unlock)) {
    if (value == kUnlock) unlocked_until_ = now + kUnlocked;
    return;
  }
  if (now >= unlocked_until_) return;
  if (command[2] == static_cast<std::uint8_t>(Register::save)) {
    busy_until_ = now + kBusySaving;
    if (value != kSave) return;
    saved_ = active_;
    ++saves_;
  } else if (auto* place = setting(command[2])) {
    *place = value;
    if (place == &active_.rate) next_cycle_ = now;
  }
}

}  // namespace drover::witmotion
