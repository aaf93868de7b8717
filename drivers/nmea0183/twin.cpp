// Errors, faults and the clock of the simulated receiver.
#include "drivers/nmea0183/twin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "drivers/nmea0183/fields.h"
#include "drover/angle.h"

namespace drover::nmea0183 {
namespace {

constexpr std::size_t kHistory = 2048;
constexpr Duration kSampleSpacing = std::chrono::milliseconds(2);
// A solution that gets worse wanders off; one that gets better is there soon.
constexpr double kWorsens_s = 3.0;
constexpr double kImproves_s = 0.3;
constexpr double kHeadingErrorTau_s = 0.5;
constexpr double kVerticalFactor = 1.5;
constexpr double kNormalAge_s = 1.0;
constexpr double kCourseNeeds_mps = 0.1;
constexpr double kPositionsSmooth_s = 0.5;
constexpr std::uint64_t kFaultStream = 0x6661756C74U;

struct KindOfFix {
  std::string_view name;
  FixQuality quality;
  int satellites;
  double hdop;
};
constexpr std::array<KindOfFix, 5> kKinds{{
    {"fix", FixQuality::rtk_fixed, 28, 0.6},
    {"float", FixQuality::rtk_float, 24, 0.7},
    {"dgps", FixQuality::dgps, 18, 0.9},
    {"single", FixQuality::single, 12, 1.2},
    {"none", FixQuality::none, 0, 99.9},
}};

const KindOfFix& kind_of(FixQuality quality) {
  for (const auto& kind : kKinds)
    if (kind.quality == quality) return kind;
  return kKinds.back();
}

double blend(double from, double to, double share) {
  return from + share * (to - from);
}
double blend_deg(double from_deg, double to_deg, double share) {
  const double turn_deg = wrap_deg(to_deg - from_deg + 180) - 180;
  return wrap_deg(from_deg + share * turn_deg);
}

// Metres a degree, WGS 84, good to some millimetres a kilometre.
double metres_per_latitude_degree(double latitude_rad) {
  return 111132.954 - 559.822 * std::cos(2 * latitude_rad) + 1.175 * std::cos(4 * latitude_rad);
}
double metres_per_longitude_degree(double latitude_rad) {
  return 111412.84 * std::cos(latitude_rad) - 93.5 * std::cos(3 * latitude_rad);
}

}  // namespace

std::optional<Utc> parse_utc(std::string_view text) {
  static constexpr std::string_view kShape = "dddd-dd-ddTdd:dd:dd";
  if (text.size() != kShape.size()) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kShape[i] == 'd' ? !digit : text[i] != kShape[i]) return std::nullopt;
  }
  const auto number = [&](std::size_t from, std::size_t length) {
    int value = 0;
    for (const char c : text.substr(from, length)) value = value * 10 + (c - '0');
    return value;
  };
  using namespace std::chrono;
  const year_month_day date{year(number(0, 4)), month(static_cast<unsigned>(number(5, 2))),
                            day(static_cast<unsigned>(number(8, 2)))};
  const int h = number(11, 2);
  const int min = number(14, 2);
  const int s = number(17, 2);
  if (!date.ok() || h > 23 || min > 59 || s > 59) return std::nullopt;
  return sys_days(date) + hours(h) + minutes(min) + seconds(s);
}

Nmea0183Twin::Nmea0183Twin(const Options& options, std::uint64_t seed)
    : configured_period_(from_s(1 / options.number("output_rate_Hz"))),
      latency_(from_s(options.number("output_latency_s"))),
      talker_(options.text("talker")),
      sigma_fix_m_(options.number("sigma_fix_m")),
      sigma_float_m_(options.number("sigma_float_m")),
      sigma_dgps_m_(options.number("sigma_dgps_m")),
      sigma_single_m_(options.number("sigma_single_m")),
      heading_sigma_deg_(options.number("heading_sigma_deg")),
      speed_sigma_mps_(options.number("speed_sigma_mps")),
      speed_of_positions_(options.text("speed_from") == "positions"),
      sends_{options.flag("gst"), options.flag("hdt")},
      gst_factor_(options.number("gst_factor")),
      undulation_m_(options.number("undulation_m")),
      noise_(seed),
      fault_noise_(seed ^ kFaultStream),
      east_(options.number("correlation_s"), noise_),
      north_(options.number("correlation_s"), noise_),
      up_(options.number("correlation_s"), noise_),
      heading_error_(kHeadingErrorTau_s, noise_),
      history_(kHistory) {
  const auto utc = parse_utc(options.text("utc_start"));
  if (!utc) throw std::runtime_error("utc_start is not of the form yyyy-mm-ddThh:mm:ss");
  utc_start_ = *utc;
  if (talker_.size() != 2) throw std::runtime_error("talker must have two letters");
  if (!set_state(options.text("first_fix"), kNever))
    throw std::runtime_error("first_fix is not a kind of fix");
  sigma_m_ = asked_sigma_m();
}

void Nmea0183Twin::remember(Time now, const GnssTruth& truth) {
  if (now - history_[newest_].at >= kSampleSpacing) newest_ = (newest_ + 1) % kHistory;
  history_[newest_] = {now, truth};
}

GnssTruth Nmea0183Twin::truth_at(Time at) const {
  const Sample* later = &history_[newest_];
  for (std::size_t back = 1; back < kHistory && later->at > at; ++back) {
    const Sample& earlier = history_[(newest_ + kHistory - back) % kHistory];
    if (earlier.at == kNever) break;
    if (earlier.at > at) {
      later = &earlier;
      continue;
    }
    const double share = to_s(at - earlier.at) / to_s(later->at - earlier.at);
    const GnssTruth& a = earlier.truth;
    const GnssTruth& b = later->truth;
    return {.latitude_deg = blend(a.latitude_deg, b.latitude_deg, share),
            .longitude_deg = blend(a.longitude_deg, b.longitude_deg, share),
            .altitude_m = blend(a.altitude_m, b.altitude_m, share),
            .heading_deg = blend_deg(a.heading_deg, b.heading_deg, share),
            .speed_mps = blend(a.speed_mps, b.speed_mps, share),
            .course_deg = blend_deg(a.course_deg, b.course_deg, share),
            .ahead_deg = blend_deg(a.ahead_deg, b.ahead_deg, share)};
  }
  return later->truth;
}

std::size_t Nmea0183Twin::on_tick(Time now, const GnssTruth& truth, std::span<char> out) {
  if (!started_) {
    started_ = true;
    start_ = now;
    next_epoch_ = now;
    last_epoch_ = now - period();
  }
  remember(now, truth);
  std::size_t written = 0;
  while (next_epoch_ + latency_ + faults_.delay(now) <= now) {
    if (out.size() - written < kMaxEpochBytes) break;
    written += write_epoch(next_epoch_, out.subspan(written));
    next_epoch_ += period();
  }
  return written;
}

std::size_t Nmea0183Twin::write_epoch(Time at, std::span<char> out) {
  // Always solved, so that a silence does not change the noise after it.
  const Solution solution = solve(at);
  if (faults_.output == TwinFaults::Output::silent) return 0;
  Sentences sends = sends_;
  if (faults_.gst_lost) sends.gst = false;
  const std::size_t size = compose(solution, talker_, out, sends);
  damage(out.first(size));
  return size;
}

double Nmea0183Twin::asked_sigma_m() const {
  switch (quality_) {
    case FixQuality::rtk_fixed: return sigma_fix_m_;
    case FixQuality::rtk_float: return sigma_float_m_;
    case FixQuality::dgps: return sigma_dgps_m_;
    default: return sigma_single_m_;
  }
}

Solution Nmea0183Twin::solve(Time at) {
  const double elapsed_s = to_s(at - last_epoch_);
  last_epoch_ = at;
  const Time measured = at - faults_.stamp_late;
  const GnssTruth truth = truth_at(measured);

  Solution solution;
  const Utc utc = utc_start_ + (at - start_);
  const auto midnight = std::chrono::floor<std::chrono::days>(utc);
  const std::chrono::year_month_day date(midnight);
  solution.utc_of_day = utc - midnight;
  solution.year = static_cast<int>(date.year());
  solution.month = static_cast<int>(static_cast<unsigned>(date.month()));
  solution.day = static_cast<int>(static_cast<unsigned>(date.day()));

  solution.position = measure_position(measured, truth, elapsed_s);
  const bool solved = quality_ != FixQuality::none;
  solution.sigma_up_m = solved ? gst_factor_ * sigma_m_ * kVerticalFactor : kAbsent;
  // Always measured: what is not told does not change the noise after it.
  follow_positions(solution.position, elapsed_s);
  const GnssVelocity velocity = measure_velocity(truth);
  const double heading_deg = measure_heading_deg(measured + faults_.heading_epoch, elapsed_s);
  if (solved) solution.velocity = velocity;
  if (solved && !faults_.heading_lost) solution.heading.heading_deg = heading_deg;
  if (faults_.stuck) {
    solution.position = last_.position;
    solution.velocity = last_.velocity;
  }
  last_ = solution;
  return solution;
}

GnssVelocity Nmea0183Twin::measure_velocity(const GnssTruth& truth) {
  const bool noisy = faults_.speed_noise_mps > 0;
  const double sigma_mps = noisy ? faults_.speed_noise_mps : speed_sigma_mps_;
  const double along_mps = sigma_mps * noise_.normal();
  const double across_mps = sigma_mps * noise_.normal();
  GnssVelocity velocity;
  double course_deg = 0;
  if (speed_of_positions_ && !noisy) {
    velocity.speed_mps = std::hypot(smooth_east_mps_, smooth_north_mps_);
    course_deg = to_deg(std::atan2(smooth_east_mps_, smooth_north_mps_));
  } else {
    // At rest a receiver tells the length of its noise.
    velocity.speed_mps = noisy ? std::hypot(truth.speed_mps + along_mps, across_mps)
                               : std::max(0.0, truth.speed_mps + along_mps);
    course_deg = truth.course_deg + to_deg(std::atan2(across_mps, velocity.speed_mps));
  }
  if (velocity.speed_mps >= kCourseNeeds_mps) velocity.course_deg = wrap_deg(course_deg);
  return velocity;
}

// Not of the epoch after a gap: a place that was not measured has no speed.
void Nmea0183Twin::follow_positions(const GnssPosition& measured, double elapsed_s) {
  const double latitude_rad = to_rad(measured.latitude_deg);
  const double east_m = (measured.longitude_deg - measured_.longitude_deg) *
                        metres_per_longitude_degree(latitude_rad);
  const double north_m =
      (measured.latitude_deg - measured_.latitude_deg) * metres_per_latitude_degree(latitude_rad);
  measured_ = measured;
  if (!std::isfinite(east_m) || !(elapsed_s > 0)) {
    smooth_east_mps_ = smooth_north_mps_ = 0;
    return;
  }
  const double share = 1 - std::exp(-elapsed_s / kPositionsSmooth_s);
  smooth_east_mps_ = blend(smooth_east_mps_, east_m / elapsed_s, share);
  smooth_north_mps_ = blend(smooth_north_mps_, north_m / elapsed_s, share);
}

double Nmea0183Twin::measure_heading_deg(Time at, double elapsed_s) {
  const double error_deg = heading_sigma_deg_ * heading_error_.step(elapsed_s, noise_);
  const double wrong_deg = faults_.heading_off_deg + (faults_.heading_flip ? 180 : 0);
  return wrap_deg(truth_at(at).heading_deg + error_deg + wrong_deg);
}

GnssPosition Nmea0183Twin::measure_position(Time at, const GnssTruth& truth, double elapsed_s) {
  const double asked_m = asked_sigma_m();
  const double tau_s = asked_m > sigma_m_ ? kWorsens_s : kImproves_s;
  sigma_m_ = asked_m + (sigma_m_ - asked_m) * std::exp(-elapsed_s / tau_s);
  // The epoch at hand was measured a latency ago, perhaps before the drift began.
  const Offset drift = faults_.drift.at(at);
  const double east_m =
      sigma_m_ * east_.step(elapsed_s, noise_) + faults_.jump.east_m + drift.east_m;
  const double north_m =
      sigma_m_ * north_.step(elapsed_s, noise_) + faults_.jump.north_m + drift.north_m;
  const double up_m = sigma_m_ * kVerticalFactor * up_.step(elapsed_s, noise_);

  GnssPosition position;
  const KindOfFix& kind = kind_of(quality_);
  position.quality = quality_;
  position.satellites = kind.satellites;
  position.hdop = kind.hdop;
  if (quality_ == FixQuality::none) return position;
  const double latitude_rad = to_rad(truth.latitude_deg);
  position.latitude_deg = truth.latitude_deg + north_m / metres_per_latitude_degree(latitude_rad);
  position.longitude_deg = truth.longitude_deg + east_m / metres_per_longitude_degree(latitude_rad);
  position.undulation_m = undulation_m_;
  position.altitude_msl_m = truth.altitude_m - undulation_m_ + up_m;
  position.sigma_east_m = gst_factor_ * sigma_m_;
  position.sigma_north_m = gst_factor_ * sigma_m_;
  if (quality_ != FixQuality::single) {
    position.correction_age_s = kNormalAge_s;
    if (faults_.corrections_lost_at)
      position.correction_age_s += std::max(0.0, to_s(at - *faults_.corrections_lost_at));
  }
  return position;
}

void Nmea0183Twin::damage(std::span<char> epoch) {
  if (faults_.output == TwinFaults::Output::garbage) {
    for (char& c : epoch) c = static_cast<char>(fault_noise_.bits() & 0xFFU);
    return;
  }
  if (faults_.bad_checksum_one_in <= 0) return;
  for (std::size_t i = 0; i + 1 < epoch.size(); ++i) {
    if (epoch[i] != '*') continue;
    if (fault_noise_.uniform() * faults_.bad_checksum_one_in < 1)
      epoch[i + 1] = epoch[i + 1] == '0' ? '1' : '0';
  }
}

Duration Nmea0183Twin::period() const {
  return faults_.rate_Hz > 0 ? from_s(1 / faults_.rate_Hz) : configured_period_;
}

bool Nmea0183Twin::set_state(std::string_view name, Time now) {
  for (const auto& kind : kKinds) {
    if (name != kind.name) continue;
    quality_ = kind.quality;
    faults_.output = TwinFaults::Output::sentences;
    return true;
  }
  return faults_.set(name, now, history_[newest_].truth.ahead_deg);
}

}  // namespace drover::nmea0183
