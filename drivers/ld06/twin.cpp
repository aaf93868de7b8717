#include "drivers/ld06/twin.h"

#include <algorithm>
#include <cmath>

#include "drivers/twin_states.h"
#include "drover/angle.h"

namespace drover::ld06 {
namespace {

constexpr double kNoise_m = 0.01;  // the maker names 10 mm up to half a metre, 30 mm beyond
constexpr double kReach_m = 12;
constexpr double kNearest_m = 0.02;
constexpr double kCap_m = 0.04;
constexpr double kSunShare = 0.3;
constexpr double kNoiseShare = 0.05;
constexpr double kSpotFrom_rad = to_rad(70);  // counter-clockwise from its x
constexpr double kSpotTo_rad = to_rad(110);
constexpr double kLeastTurn_Hz = 1;
constexpr double kMostTurn_Hz = 20;

}  // namespace

Ld06Twin::Ld06Twin(bool upside_down, std::uint64_t seed)
    : upside_down_(upside_down),
      random_(seed),
      turn_(static_cast<std::size_t>(kPoints_Hz / kLeastTurn_Hz)) {}

std::size_t Ld06Twin::on_tick(Time now, const RangeOf& range_of, std::span<char> out) {
  if (start_ == kNever) start_ = now;
  std::size_t size = 0;
  while (true) {
    // Twelve beams at 4500 a second: in whole numbers, so that an hour has no drift.
    const Time due = start_ + Duration{(packets_ + 1) * 8'000'000 / 3};
    if (due > now) return size;
    ++packets_;
    const Slice slice = measure(range_of, due);
    if (fault_ == Fault::silent || size + kPacketSize > out.size()) continue;
    for (const std::uint8_t byte : encode(slice)) out[size++] = static_cast<char>(byte);
  }
}

Slice Ld06Twin::measure(const RangeOf& range_of, Time at) {
  const auto beams = static_cast<std::size_t>(std::lround(kPoints_Hz / turn_Hz_));
  const double step_cdeg = static_cast<double>(kTurn_cdeg) / static_cast<double>(beams);
  const auto angle_cdeg = [&] {
    return static_cast<std::uint16_t>(std::lround(static_cast<double>(beam_) * step_cdeg) %
                                      kTurn_cdeg);
  };
  Slice slice;
  const bool stands = fault_ == Fault::stuck;
  slice.speed_degps = static_cast<std::uint16_t>(stands ? 0 : std::lround(turn_Hz_ * 360));
  slice.stamp_ms = static_cast<std::uint16_t>((at - start_) / std::chrono::milliseconds(1) %
                                              std::int64_t{kStampWrap});
  beam_ %= beams;
  slice.start_cdeg = slice.end_cdeg = angle_cdeg();
  for (Beam& each : slice.beams) {
    slice.end_cdeg = angle_cdeg();
    if (fault_ != Fault::frozen) turn_[beam_] = beam(range_of, to_rad(slice.end_cdeg / 100.0));
    each = turn_[beam_];
    if (!stands) beam_ = (beam_ + 1) % beams;
  }
  return slice;
}

Beam Ld06Twin::beam(const RangeOf& range_of, double clockwise_rad) {
  const double bearing_rad = wrap_rad(upside_down_ ? clockwise_rad : -clockwise_rad);
  const double chance = random_.uniform();
  switch (fault_) {
    case Fault::covered: return beam_at(kCap_m);
    case Fault::dark: return {};
    case Fault::sun:
      if (chance >= kSunShare) return {};
      break;
    case Fault::noise:
      if (chance < kNoiseShare) return beam_at(kReach_m * random_.uniform());
      break;
    case Fault::dirty:
      if (bearing_rad >= kSpotFrom_rad && bearing_rad <= kSpotTo_rad) return beam_at(kCap_m);
      break;
    default: break;
  }
  return beam_at(range_of(bearing_rad));
}

Beam Ld06Twin::beam_at(double range_m) {
  const double told_m = range_m + kNoise_m * std::min(1.0, range_m) * random_.normal();
  if (!(range_m > 0) || !(told_m >= kNearest_m && told_m <= kReach_m)) return {};
  // Weaker with the distance, and never the same.
  const double intensity = 230 - 10 * told_m + 3 * random_.normal();
  return {static_cast<std::uint16_t>(std::lround(told_m * 1000)),
          static_cast<std::uint8_t>(std::clamp(intensity, 1.0, 255.0))};
}

bool Ld06Twin::set_state(std::string_view name, Time) {
  if (const auto turn_Hz = number_after(name, "turn")) {
    if (*turn_Hz < kLeastTurn_Hz || *turn_Hz > kMostTurn_Hz) return false;
    fault_ = Fault::turn;
    turn_Hz_ = *turn_Hz;
    return true;
  }
  static constexpr struct {
    std::string_view name;
    Fault fault;
  } kStates[] = {{"", Fault::none},         {"covered", Fault::covered}, {"dark", Fault::dark},
                 {"frozen", Fault::frozen}, {"sun", Fault::sun},         {"noise", Fault::noise},
                 {"dirty", Fault::dirty},   {"stuck", Fault::stuck},     {"silent", Fault::silent}};
  for (const auto& state : kStates) {
    if (state.name != name) continue;
    fault_ = state.fault;
    turn_Hz_ = kTurn_Hz;
    return true;
  }
  return false;
}

}  // namespace drover::ld06
