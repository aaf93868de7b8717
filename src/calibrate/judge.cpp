#include "calibrate/judge.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::calibrate {
namespace {

constexpr double kShortest_s = 20;
constexpr double kLeastWay_m = 5;
constexpr std::size_t kLeastPlaces = 100;
constexpr double kLook_s = 0.5;
constexpr double kTurns_radps = 0.05;
constexpr double kMoves_mps = 0.05;
constexpr double kWobble_mps = 0.1;
constexpr double kBothWays_rad = kPi;  // to each side, at least
constexpr double kStraight_m = 8;      // at least, to tell a direction
/// Wheels that skid turn the base about a point that may lie so far ahead of base_link or behind.
constexpr double kSkids_m = 0.05;
constexpr double kSigmas = 2.4;  // of the interval: few pieces tell how it scatters

constexpr const char* kCircles = "drive a left and a right circle";
constexpr const char* kStraightOn = "drive 20 m straight, there and back";

std::string one_way(const DriveFacts& facts) {
  const bool left = facts.left_rad < facts.right_rad;
  const double turned_deg = to_deg(left ? facts.left_rad : facts.right_rad);
  std::string said = "it turned only ";
  said += std::to_string(static_cast<int>(std::min(turned_deg, 1e6))) + " degrees to the ";
  said += left ? "left" : "right";
  return said + ": " + kCircles;
}

class Judge final {
 public:
  explicit Judge(const Evidence& evidence) : e_(evidence) {}

  std::vector<Found> all() {
    wheels();
    turns();
    arm();
    heading();
    lateness();
    gyro();
    lags();
    return std::move(found_);
  }

 private:
  struct Limits {
    double floor = 0;  ///< no interval is smaller: what no drive shows
    double most = 0;   ///< a larger one tells nothing
  };

  double sigma(std::size_t number) const { return std::sqrt(e_.fit.covariance[number][number]); }
  bool turned_both_ways() const {
    return e_.facts.left_rad > kBothWays_rad && e_.facts.right_rad > kBothWays_rad;
  }

  void refuse(Quantity what, std::string why) {
    Found found;
    found.what = what;
    found.refused = std::move(why);
    found_.push_back(std::move(found));
  }
  /// `advice`: when the interval is larger than is of any use.
  void tell(Quantity what, double value, double one_sigma, const Limits& limits,
            const std::string& advice) {
    const double interval = std::hypot(kSigmas * one_sigma, limits.floor);
    if (!(interval < limits.most) || !std::isfinite(value))
      return refuse(what, "the drive does not show it well enough: " + advice);
    Found found;
    found.what = what;
    found.value = value;
    found.interval = interval;
    found_.push_back(std::move(found));
  }
  void configured(double value) {
    found_.back().configured = value;
    found_.back().has_configured = true;
  }

  void wheels() {
    const double radius_m = e_.configured.wheel_radius_m;
    const auto& c = e_.fit.covariance;
    const auto& v = e_.fit.value;
    const double mean_sigma =
        std::sqrt(std::max(0.0, c[kLeftScale][kLeftScale] + c[kRightScale][kRightScale] +
                                    2 * c[kLeftScale][kRightScale])) /
        2;
    const Limits limits{0.001 * radius_m, 0.02 * radius_m};
    tell(Quantity::wheel_radius_m, radius_m * (v[kLeftScale] + v[kRightScale]) / 2,
         radius_m * mean_sigma, limits, kStraightOn);
    configured(radius_m);
    for (const auto& [what, number] : {std::pair{Quantity::left_radius_m, kLeftScale},
                                       std::pair{Quantity::right_radius_m, kRightScale}}) {
      tell(what, radius_m * v[number], radius_m * sigma(number), limits,
           std::string(kStraightOn) + ", and " + (kCircles + 6));
      configured(radius_m);
    }
  }

  void turns() {
    const double slip = e_.configured.yaw_slip_factor;
    const double gain = e_.fit.value[kTurnGain];
    if (!turned_both_ways()) {
      refuse(Quantity::yaw_slip_factor, one_way(e_.facts));
    } else {
      tell(Quantity::yaw_slip_factor, slip / gain, slip / (gain * gain) * sigma(kTurnGain),
           {0.01 * slip / gain, 0.15 * slip / gain}, kCircles);
    }
    configured(slip);
  }

  void arm() {
    const std::string advice = std::string(kCircles) + ", and " + kDriveSpeeds;
    const Limits across{0.003, 0.06};
    const Limits along = e_.configured.skids ? Limits{kSkids_m, 0.08} : across;
    for (const auto& [what, number, is] :
         {std::tuple{Quantity::antenna_x_m, kArmX, e_.configured.antenna_x_m},
          std::tuple{Quantity::antenna_y_m, kArmY, e_.configured.antenna_y_m}}) {
      if (!turned_both_ways()) {
        refuse(what, one_way(e_.facts));
      } else {
        tell(what, e_.fit.value[number], sigma(number), number == kArmX ? along : across, advice);
      }
      configured(is);
    }
  }

  void heading() {
    if (e_.drive.headings_rad.empty()) {
      refuse(Quantity::heading_offset_deg, "the receiver told no heading");
    } else if (e_.facts.straight_m < kStraight_m) {
      refuse(Quantity::heading_offset_deg,
             std::string("there was hardly a straight way: ") + kStraightOn);
    } else {
      double offset_deg = to_deg(wrap_rad(-e_.fit.value[kLine]));
      const double turns =
          std::round((e_.configured.heading_baseline_offset_deg - offset_deg) / 360);
      offset_deg += 360 * turns;  // spelled as the configuration does
      tell(Quantity::heading_offset_deg, offset_deg, to_deg(sigma(kLine)), {0.2, 1.0}, kStraightOn);
    }
    configured(e_.configured.heading_baseline_offset_deg);
  }

  void lateness() {
    tell(Quantity::position_late_s, e_.fit.value[kPlaceLate], sigma(kPlaceLate), {0.005, 0.06},
         kDriveSpeeds);
    if (e_.drive.headings_rad.empty())
      return refuse(Quantity::heading_late_s, "the receiver told no heading");
    tell(Quantity::heading_late_s, e_.fit.value[kHeadingLate], sigma(kHeadingLate), {0.008, 0.06},
         kCircles);
  }

  void gyro() {
    for (const auto what : {Quantity::gyro_scale, Quantity::gyro_bias_radps}) {
      const bool scale = what == Quantity::gyro_scale;
      if (e_.drive.gyro_radps.empty()) {
        refuse(what, "there is no gyro");
      } else if (scale && !turned_both_ways()) {
        refuse(what, one_way(e_.facts));
      } else if (scale) {
        tell(what, e_.fit.value[kGyroScale], sigma(kGyroScale), {0.0005, 0.02}, kCircles);
      } else {
        tell(what, e_.fit.value[kGyroBias], sigma(kGyroBias), {0.00005, 0.005},
             "stand for 10 s before and after the drive");
      }
      if (scale) configured(1);
    }
  }

  void lags() {
    late(Quantity::drive_lag_s, e_.drive_lag, 0.005);
    configured(e_.configured.drive_lag_s);
    late(Quantity::speed_late_s, e_.speed_late, 0.012);
  }
  void late(Quantity what, const Late& late, double floor_s) {
    if (!late.known) return refuse(what, late.refused);
    tell(what, late.late_s, late.sigma_s, {floor_s, 0.1}, kDriveSpeeds);
  }

  const Evidence& e_;
  std::vector<Found> found_;
};

}  // namespace

std::string too_little(const Drive& drive) {
  if (drive.rims.size() < 2) return "no wheel speeds were recorded";
  if (drive.places.size() < kLeastPlaces)
    return "there are only " + std::to_string(drive.places.size()) +
           " positions with an RTK fix: drive where the receiver has one";
  const double begin_s = std::max(drive.rims.front().time_s, drive.places.front().time_s);
  const double end_s = std::min(drive.rims.back().time_s, drive.places.back().time_s);
  if (end_s - begin_s < kShortest_s)
    return "wheels and an RTK fix were heard together for less than 20 s";
  if (end_s - begin_s > kLongestDrive_s)
    return "it is longer than half an hour: choose the part with the calibration drive";
  double way_m = 0;
  for (std::size_t i = 1; i < drive.rims.size(); ++i) {
    const RimRow& row = drive.rims[i];
    if (row.time_s < begin_s || row.time_s > end_s) continue;
    const double step_s = std::min(row.time_s - drive.rims[i - 1].time_s, kLongestGap_s);
    way_m += step_s * (std::abs(row.left_mps) + std::abs(row.right_mps)) / 2;
  }
  if (way_m < kLeastWay_m)
    return "its wheels rolled less than 5 m with an RTK fix: " + std::string(kStraightOn) +
           ", and a left and a right circle";
  return {};
}

void measure_drive(const Drive& drive, const Chain& chain, DriveFacts& facts) {
  facts.places = drive.places.size();
  const double begin_s = chain.node_s(0);
  const double end_s = chain.node_s(chain.size() - 1);
  facts.duration_s = end_s - begin_s;
  std::vector<double> times;
  std::vector<double> speeds;
  for (double t = begin_s; t + kLook_s <= end_s; t += kLook_s) {
    const double way_m = chain.rolled_m(t, t + kLook_s);
    const double turn_rad = chain.turned_rad(t + kLook_s) - chain.turned_rad(t);
    const bool turns = std::abs(turn_rad) > kTurns_radps * kLook_s;
    times.push_back(t);
    speeds.push_back(way_m / kLook_s);
    facts.way_m += std::abs(way_m);
    if (turns) (turn_rad > 0 ? facts.left_rad : facts.right_rad) += std::abs(turn_rad);
    if (!turns && std::abs(way_m) > kMoves_mps * kLook_s) facts.straight_m += std::abs(way_m);
  }
  facts.speed_changes_mps = Series(std::move(times), std::move(speeds)).variation(kWobble_mps);
}

std::vector<Found> judge(const Evidence& evidence) {
  return Judge(evidence).all();
}

}  // namespace drover::calibrate
