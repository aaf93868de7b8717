#include "engine/sensors/sensors.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

/// A receiver that says for so long that it has no place is as good as silent; some tell one a
/// second.
constexpr Duration kPlaceless = std::chrono::seconds(2);
/// More is another mounting, not the shaking of a robot.
const double kTiltApart_rad = to_rad(5.0);
const double kTurnApart_radps = to_rad(5.0);

bool has_place(const GnssPosition& position) {
  switch (position.quality) {
    case FixQuality::none:
    case FixQuality::estimated:
    case FixQuality::manual:
    case FixQuality::simulator: return false;
    default: return std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
  }
}

bool is_of_a_sensor(const Measurement& m) {
  return std::holds_alternative<GnssPosition>(m.value) ||
         std::holds_alternative<GnssVelocity>(m.value) ||
         std::holds_alternative<GnssHeading>(m.value) ||
         std::holds_alternative<ImuSample>(m.value) ||
         std::holds_alternative<BatterySample>(m.value);
}

std::uint64_t& count(std::array<std::array<std::uint64_t, kMaxOfKind>, 3>& samples, SensorKind kind,
                     std::size_t which) {
  return samples[static_cast<std::size_t>(kind)][which];
}

Name name_of(const SensorList& all, std::size_t which, const char* plain) {
  return all.size() > 1 ? all[which].name : Name(plain);
}

}  // namespace

Sensors::Sensors(const EngineConfig& config)
    : config_(config), receivers_(config.receivers), imus_(config.imus) {
  position_at_.fill(kNever);
  placed_at_.fill(kNever);
  imu_at_.fill(kNever);
}

[[gnu::hot]] bool Sensors::take(const Measurement& m, const Estimator& estimator) {
  if (!is_of_a_sensor(m)) return true;  // there may be more drives than sensors of a kind
  const std::size_t source = m.source;
  if (source >= kMaxOfKind) return false;
  if (const auto* position = std::get_if<GnssPosition>(&m.value)) {
    ++count(samples_, SensorKind::receiver, source);
    if (m.time < position_at_[source]) return source == receiver();
    positions_[source] = *position;
    position_at_[source] = m.time;
    if (has_place(*position)) placed_at_[source] = m.time;
    if (source == receiver()) return true;
    if (const Apart apart = estimator.apart(*position, m.source, m.time); apart.known)
      places_agree_[source].update(m.time, apart.m > apart.permitted_m);
    return false;
  }
  if (std::holds_alternative<GnssVelocity>(m.value) || std::holds_alternative<GnssHeading>(m.value))
    return source == receiver();
  if (std::holds_alternative<ImuSample>(m.value)) {
    ++count(samples_, SensorKind::imu, source);
    imu_at_[source] = std::max(imu_at_[source], m.time);
    return source == imu();
  }
  if (const auto* sample = std::get_if<BatterySample>(&m.value)) {
    ++count(samples_, SensorKind::battery, source);
    BatterySnapshot& battery = batteries_[source];
    if (m.time < battery.time) return true;
    battery.sample = *sample;
    battery.time = m.time;
  }
  return true;
}

/// Of a sample that came too late to count its words do not count, either.
void Sensors::take_words(const Measurement& m, std::string_view words) {
  if (!std::holds_alternative<BatterySample>(m.value) || m.source >= kMaxOfKind) return;
  BatterySnapshot& battery = batteries_[m.source];
  if (m.time == battery.time) battery.alarms.assign(words);
}

/// Both tell of the same base: they tilt and turn alike.
void Sensors::compare_imus(Time now, const Estimator& estimator) {
  const auto& used = estimator.imu(imu());
  if (!imu_trusted_[imu()] || !used.tilt().known()) return;
  for (std::size_t i = 0; i < config_.imus.size(); ++i) {
    const auto& other = estimator.imu(i);
    if (i == imu() || !imu_trusted_[i] || !other.tilt().known()) continue;
    const double tilt_rad = std::hypot(other.tilt().roll_rad() - used.tilt().roll_rad(),
                                       other.tilt().pitch_rad() - used.tilt().pitch_rad());
    const double turn_radps = std::abs(other.turn_radps() - used.turn_radps());
    turns_agree_[i].update(now, tilt_rad > kTiltApart_rad || turn_radps > kTurnApart_radps);
  }
}

Reason Sensors::look_at(const SensorList& all, const Choice& choice,
                        const SensorConditions& conditions, const char* what) const {
  Reason said;
  if (all.size() < 2) return said;
  const auto put = [&said](const char* format, const Name& a, std::string_view b) {
    said.format(format, static_cast<int>(a.view().size()), a.view().data(),
                static_cast<int>(b.size()), b.data());
  };
  const Name& steers = all[choice.steers()].name;
  const Name& used = all[choice.in_use()].name;
  if (choice.is_spare()) {
    put(!conditions[choice.in_use()].well ? "%.*s gives nothing to go by, and neither does %.*s"
        : conditions[choice.steers()].well
            ? "%.*s is back, and taken again when the robot stands: %.*s steers so far"
            : "%.*s gives nothing to go by: %.*s steers in its place",
        steers, used.view());
    return said;
  }
  for (std::size_t i = 0; i < all.size() && said.empty(); ++i) {
    if (all[i].role != Role::spare) continue;
    if (!conditions[i].well) {
      put("the spare %.*s gives nothing to go by%.*s", all[i].name, "");
    } else if (!conditions[i].fits) {
      put("the spare %.*s contradicts %.*s: it takes over at rest only", all[i].name, what);
    }
  }
  return said;
}

void Sensors::look_at_batteries(const Environment& environment) {
  const SensorList& all = config_.batteries;
  const auto heard = [&](std::size_t i) {
    return environment.battery[i].state == SourceState::fresh && batteries_[i].time != kNever;
  };
  bool steers = false;
  for (std::size_t i = 0; i < all.size(); ++i)
    steers = steers || (all[i].role == Role::steers && heard(i));
  bool found = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    battery_counts_[i] =
        all[i].role == Role::steers || (all[i].role == Role::spare && !steers && heard(i));
    if (!battery_counts_[i] || !heard(i)) continue;
    const bool emptier =
        batteries_[i].sample.soc_percent < batteries_[battery_shown_].sample.soc_percent;
    if (!found || emptier) battery_shown_ = i;
    found = true;
  }
}

HandOver Sensors::update(Time now, const Environment& environment, const Estimator& estimator,
                         bool stands) {
  if (begun_ == kNever) begun_ = now;
  SensorConditions receivers;
  SensorConditions imus;
  for (std::size_t i = 0; i < kMaxOfKind; ++i) {
    const auto fresh = [](const SourceHealth& source) {
      return source.state == SourceState::fresh;
    };
    imu_trusted_[i] = fresh(environment.imu[i]);
    receivers[i] = {fresh(environment.gnss[i]) && now - placed_at_[i] <= kPlaceless,
                    places_agree_[i].agree()};
    imus[i] = {imu_trusted_[i], turns_agree_[i].agree()};
  }
  if (config_.imus.size() > 1) compare_imus(now, estimator);
  const HandOver change{receivers_.update(now, receivers, stands), imus_.update(now, imus, stands)};
  if (config_.batteries.size() > 1) look_at_batteries(environment);
  caution_.clear();
  if (now - begun_ < Choice::kBoots) return change;
  caution_ = look_at(config_.receivers, receivers_, receivers, "the position");
  const Reason other = look_at(config_.imus, imus_, imus, "the other IMU");
  if (caution_.empty() || other.empty()) {
    if (!other.empty()) caution_ = other;
    return change;
  }
  const Reason first = caution_;
  caution_.format("%.*s; %.*s", static_cast<int>(first.view().size()), first.view().data(),
                  static_cast<int>(other.view().size()), other.view().data());
  return change;
}

Name Sensors::receiver_name(const char* plain) const {
  return name_of(config_.receivers, receiver(), plain);
}
Name Sensors::imu_name(const char* plain) const {
  return name_of(config_.imus, imu(), plain);
}

void Sensors::fill(Snapshot& snapshot, const Environment& environment) const {
  std::size_t at = 0;
  const auto put = [&](SensorKind kind, const SensorList& all,
                       const std::array<SourceHealth, kMaxOfKind>& health, const auto& special) {
    for (std::size_t i = 0; i < all.size() && at < snapshot.sensors.capacity(); ++i) {
      if (at == snapshot.sensors.size()) snapshot.sensors.resize(at + 1);
      SensorSnapshot& it = snapshot.sensors[at++];
      it.kind = kind;
      it.name = all[i].name;
      it.role = all[i].role;
      it.health = health[i].state;
      it.source = {health[i].reason, samples_[static_cast<std::size_t>(kind)][i], health[i].bad,
                   health[i].overflows};
      special(it, i);
    }
  };
  put(SensorKind::receiver, config_.receivers, environment.gnss,
      [this](SensorSnapshot& it, std::size_t i) {
        it.in_use = i == receiver();
        it.time = position_at_[i];
        it.last = positions_[i];
      });
  put(SensorKind::imu, config_.imus, environment.imu, [this](SensorSnapshot& it, std::size_t i) {
    it.in_use = i == imu();
    it.time = imu_at_[i];
  });
  put(SensorKind::battery, config_.batteries, environment.battery,
      [this](SensorSnapshot& it, std::size_t i) {
        it.in_use = battery_counts_[i];
        it.time = batteries_[i].time;
        it.last = batteries_[i].sample;
        it.alarms = batteries_[i].alarms;
      });
}

}  // namespace drover::engine
