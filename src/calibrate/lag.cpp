#include "calibrate/lag.h"

#include <algorithm>
#include <cmath>

#include "calibrate/late_fit.h"

namespace drover::calibrate {
namespace {

constexpr double kGrid_s = 0.02;
constexpr double kHolds_s = 0.06;
constexpr double kMostLag_s = 0.8;
constexpr double kLeastChanges_mps = 1.0;  // two starts and stops at 0.25 m/s
constexpr double kToldWobble_mps = 0.05;
constexpr double kAlikeFor_s = 6;
constexpr double kComparedFrom_mps = 0.15;
constexpr double kAlike = 0.5;     // correlation of errors from which on they are the same
constexpr double kUnlike = 0.3;    // and up to which they are not
constexpr double kBehind_s = 0.1;  // a speed that is so much later than positions is made of them

/// What a side was told and did.
struct Side {
  Series told;
  std::vector<double> did;  ///< each kGrid_s
};

/// Between rows that are close a straight line, for a ramp is told in steps; a farther one holds
/// until shortly before the next.
Series column(const std::vector<RimRow>& rows, double RimRow::*which) {
  std::vector<double> times;
  std::vector<double> values;
  for (const RimRow& row : rows) {
    if (!times.empty() && row.time_s - times.back() > kHolds_s) {
      times.push_back(row.time_s - kGrid_s / 2);
      values.push_back(values.back());
    }
    times.push_back(row.time_s);
    values.push_back(row.*which);
  }
  return {std::move(times), std::move(values)};
}

class DriveLag final {
 public:
  explicit DriveLag(const Drive& drive) {
    begin_s_ = std::max(drive.commands.front().time_s, drive.rims.front().time_s) + kMostLag_s;
    end_s_ = std::min(drive.commands.back().time_s, drive.rims.back().time_s);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto which = i == 0 ? &RimRow::left_mps : &RimRow::right_mps;
      sides_[i].told = column(drive.commands, which);
      const Series did = column(drive.rims, which);
      for (double t = begin_s_; t < end_s_; t += kGrid_s) sides_[i].did.push_back(did.at(t));
      changes_mps_ += sides_[i].told.variation(kToldWobble_mps) / 2;
    }
  }

  Late find() const {
    Late late;
    if (changes_mps_ < kLeastChanges_mps || sides_[0].did.size() < 500) {
      late.refused = std::string("the commanded speed hardly changed: ") + kDriveSpeeds;
      return late;
    }
    SmallFit<3> fit;
    fit.run(
        first_guess(), {0.005, 0.005, 0.005}, static_cast<std::size_t>(kAlikeFor_s / kGrid_s),
        [this](const auto& numbers) { return residuals(numbers); },
        [](auto numbers) {
          numbers[0] = std::clamp(numbers[0], 0.0, kMostLag_s / 2);
          numbers[1] = std::clamp(numbers[1], 0.01, kMostLag_s / 2);
          return numbers;
        });
    late.known = fit.ok;
    late.late_s = fit.value[0] + fit.value[1];
    const auto& c = fit.covariance;
    late.sigma_s = std::sqrt(std::max(0.0, c[0][0] + c[1][1] + 2 * c[0][1]));
    if (!fit.ok) late.refused = "the wheels did not follow the commands";
    return late;
  }

 private:
  using Numbers = std::array<double, 3>;  // dead time, time constant, gain

  Numbers first_guess() const {
    Numbers best{0, 0.01, 1};
    double least = -1;
    for (double dead = 0; dead < 0.35; dead += 0.05) {
      for (double lag = 0.01; lag < 0.35; lag += 0.05) {
        double sum = 0;
        for (const double r : residuals({dead, lag, 1})) sum += r * r;
        if (least >= 0 && sum >= least) continue;
        least = sum;
        best = {dead, lag, 1};
      }
    }
    return best;
  }
  std::vector<double> residuals(const Numbers& numbers) const {
    std::vector<double> off;
    off.reserve(2 * sides_[0].did.size());
    const double blend = 1 - std::exp(-kGrid_s / std::max(numbers[1], 1e-3));
    for (const Side& side : sides_) {
      double follows = side.told.at(begin_s_ - numbers[0]);
      for (std::size_t i = 0; i < side.did.size(); ++i) {
        off.push_back(side.did[i] - numbers[2] * follows);
        const double middle_s = begin_s_ + kGrid_s * (static_cast<double>(i) + 0.5) - numbers[0];
        follows += blend * (side.told.at(middle_s) - follows);
      }
    }
    return off;
  }

  double begin_s_ = 0;
  double end_s_ = 0;
  double changes_mps_ = 0;
  std::array<Side, 2> sides_;
};

/// How fast the antenna was about `time_s`, by wheels and turn.
double antenna_mps(const Chain& chain, double time_s) {
  const double rate = chain.turn_radps(time_s);
  const auto& shared = chain.shared();
  return std::hypot(chain.speed_mps(time_s) - rate * shared[kArmY], rate * shared[kArmX]);
}

/// Whether wheels tell of the time about it.
bool inside(const Chain& chain, double time_s) {
  return time_s > chain.node_s(0) + 1 && time_s < chain.node_s(chain.size() - 1) - 1;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double mean_a = 0;
  double mean_b = 0;
  const auto count = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / count;
    mean_b += b[i] / count;
  }
  double aa = 1e-12;
  double bb = 1e-12;
  double ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

/// Of the errors of the speed and of the way between positions `span_s` apart.
double error_correlation(const Drive& drive, const Chain& chain, double late_s, double span_s) {
  std::vector<double> of_speed;
  std::vector<double> of_way;
  const double place_late_s = chain.shared()[kPlaceLate];
  for (const ValueRow& row : drive.receiver_mps) {
    if (!inside(chain, row.time_s)) continue;
    const double expected = antenna_mps(chain, row.time_s - late_s);
    const auto a = antenna_at(drive.places, row.time_s - span_s);
    const auto b = antenna_at(drive.places, row.time_s - 1e-6);
    if (expected < kComparedFrom_mps || !a || !b) continue;
    const double way_mps = std::hypot(b->x_m - a->x_m, b->y_m - a->y_m) / span_s;
    const double middle_s = row.time_s - span_s / 2 - place_late_s;
    of_speed.push_back(row.value - expected);
    of_way.push_back(way_mps - antenna_mps(chain, middle_s));
  }
  return of_speed.size() < 100 ? 0 : correlation(of_speed, of_way);
}

}  // namespace

Late drive_late(const Drive& drive) {
  if (drive.commands.size() < 2) {
    Late late;
    late.refused = "no commanded speeds were recorded";
    return late;
  }
  return DriveLag(drive).find();
}

Late speed_late(const Drive& drive, const Chain& chain) {
  Late late;
  std::vector<ValueRow> rows;
  for (const ValueRow& row : drive.receiver_mps)
    if (inside(chain, row.time_s)) rows.push_back(row);
  if (rows.size() < 200) {
    late.refused = "the receiver told no speed of its own (RMC or VTG)";
    return late;
  }
  SmallFit<2> fit;
  const double rate_Hz =
      static_cast<double>(rows.size()) / std::max(1.0, rows.back().time_s - rows.front().time_s);
  fit.run(
      {chain.shared()[kPlaceLate], 1}, {0.05, 0.01},
      static_cast<std::size_t>(std::max(2.0, kAlikeFor_s * rate_Hz)),
      [&](const auto& numbers) {
        std::vector<double> off;
        off.reserve(rows.size());
        for (const ValueRow& row : rows)
          off.push_back(row.value - numbers[1] * antenna_mps(chain, row.time_s - numbers[0]));
        return off;
      },
      [](auto numbers) {
        numbers[0] = std::clamp(numbers[0], -kMostLag_s, kMostLag_s);
        return numbers;
      });
  late.known = fit.ok;
  late.late_s = fit.value[0];
  late.sigma_s = std::sqrt(fit.covariance[0][0]);
  if (!fit.ok) late.refused = "the receiver's speed does not follow the wheels";
  return late;
}

SpeedVerdict judge_speed(const Drive& drive, const Chain& chain, const Late& late,
                         double position_sigma_s) {
  SpeedVerdict verdict;
  if (!late.known) {
    verdict.refused = late.refused;
    return verdict;
  }
  const double behind_s = late.late_s - chain.shared()[kPlaceLate];
  const double sigma_s = std::hypot(late.sigma_s, position_sigma_s);
  double alike = 0;
  for (const double span_s : {0.1, 0.2, 0.3})
    alike = std::max(alike, error_correlation(drive, chain, late.late_s, span_s));
  if (alike > kAlike || behind_s - 2 * sigma_s > kBehind_s / 2) {
    verdict.source = SpeedSource::positions;
  } else if (alike < kUnlike && behind_s + 2 * sigma_s < kBehind_s) {
    verdict.source = SpeedSource::own;
  } else {
    verdict.refused =
        std::string("it is neither clearly later than the positions nor clearly not: ") +
        kDriveSpeeds;
  }
  return verdict;
}

}  // namespace drover::calibrate
