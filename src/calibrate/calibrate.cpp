#include "calibrate/calibrate.h"

#include <algorithm>
#include <cmath>

#include "calibrate/chain.h"
#include "calibrate/fit.h"
#include "calibrate/judge.h"
#include "calibrate/lag.h"
#include "calibrate/signs.h"

namespace drover::calibrate {
namespace {

bool is_good(const RimRow& row) {
  return std::isfinite(row.time_s) && std::isfinite(row.left_mps) && std::isfinite(row.right_mps);
}
bool is_good(const ValueRow& row) {
  return std::isfinite(row.time_s) && std::isfinite(row.value);
}
bool is_good(const PlaceRow& row) {
  return std::isfinite(row.time_s) && std::isfinite(row.east_m) && std::isfinite(row.north_m);
}

/// Numbers only, in the order of their times, one of each instant.
template <class Row>
void tidy(std::vector<Row>& rows) {
  std::erase_if(rows, [](const Row& row) { return !is_good(row); });
  const auto earlier = [](const Row& a, const Row& b) { return a.time_s < b.time_s; };
  std::stable_sort(rows.begin(), rows.end(), earlier);
  const auto same = [](const Row& a, const Row& b) { return !(a.time_s < b.time_s); };
  rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
}

/// Numbers stay small, whatever the time and the origin.
void shift(Drive& drive) {
  if (drive.places.empty()) return;
  const PlaceRow first = drive.places.front();
  for (PlaceRow& row : drive.places) {
    row.time_s -= first.time_s;
    row.east_m -= first.east_m;
    row.north_m -= first.north_m;
  }
  for (auto* rows : {&drive.rims, &drive.commands})
    for (RimRow& row : *rows) row.time_s -= first.time_s;
  for (auto* rows : {&drive.gyro_radps, &drive.headings_rad, &drive.receiver_mps})
    for (ValueRow& row : *rows) row.time_s -= first.time_s;
}

/// Only while wheels and an RTK fix were heard.
void keep_what_is_common(Drive& drive) {
  if (drive.rims.empty() || drive.places.empty()) return;
  const double begin_s = std::max(drive.rims.front().time_s, drive.places.front().time_s);
  const double end_s = std::min(drive.rims.back().time_s, drive.places.back().time_s);
  const auto keep = [&](auto& rows) {
    std::erase_if(rows,
                  [&](const auto& row) { return row.time_s < begin_s || row.time_s > end_s; });
  };
  keep(drive.rims);
  keep(drive.places);
  keep(drive.gyro_radps);
  keep(drive.headings_rad);
  keep(drive.receiver_mps);
  keep(drive.commands);
}

Drive tidied(const Drive& drive) {
  Drive own = drive;
  tidy(own.rims);
  tidy(own.gyro_radps);
  tidy(own.places);
  tidy(own.headings_rad);
  tidy(own.receiver_mps);
  tidy(own.commands);
  keep_what_is_common(own);
  constexpr std::size_t kLeastHeadings = 20;
  if (own.headings_rad.size() <= kLeastHeadings) own.headings_rad.clear();
  shift(own);
  return own;
}

}  // namespace

Signs signs_of(const Drive& recorded, const Configured& configured) {
  constexpr std::size_t kLeastPlaces = 20;
  const Drive drive = tidied(recorded);
  if (drive.places.size() < kLeastPlaces || drive.rims.size() < 2) {
    Signs signs;
    signs.refused = "wheels and an RTK fix were not heard together";
    return signs;
  }
  FirstGuess guess;
  return find_signs(drive, configured, guess);
}

std::vector<Quantity> worth_driving_for(const Calibration& it, const Drive& drive) {
  std::vector<Quantity> worth;
  const auto told_by_nobody = [&](Quantity what) {
    switch (what) {
      case Quantity::heading_offset_deg:
      case Quantity::heading_late_s: return drive.headings_rad.empty();
      case Quantity::gyro_scale:
      case Quantity::gyro_bias_radps: return drive.gyro_radps.empty();
      case Quantity::speed_late_s: return true;  // many receivers cannot show it, however far
      default: return false;
    }
  };
  for (const Found& found : it.found)
    if (!found.refused.empty() && !told_by_nobody(found.what)) worth.push_back(found.what);
  return worth;
}

Calibration calibrate(const Drive& recorded, const Configured& configured) {
  Calibration result;
  const Drive drive = tidied(recorded);
  result.refused = too_little(drive);
  if (!result.refused.empty()) return result;
  FirstGuess guess;
  result.signs = find_signs(drive, configured, guess);
  if (result.signs.contradict) {
    result.refused = result.signs.refused;
    return result;
  }
  Chain chain(drive, configured, result.signs, guess);
  const Fit fitted = fit(chain);
  measure_drive(drive, chain, result.facts);
  if (!fitted.ok) {
    result.refused =
        "wheels, receiver and gyro do not fit together: look at the columns and their times";
    return result;
  }
  const auto noise = [&](Noise of, double assumed) {
    return assumed * std::sqrt(fitted.scales[static_cast<std::size_t>(of)]);
  };
  result.facts.outliers = fitted.outliers;
  result.facts.place_white_m = noise(Noise::place_white, chain.assumed().place_white_m);
  result.facts.place_slow_m = noise(Noise::place_slow, chain.assumed().place_slow_m);
  result.facts.heading_white_rad = noise(Noise::heading_white, chain.assumed().heading_white_rad);
  const Late lag = drive_late(drive);
  const Late speed = speed_late(drive, chain);
  result.found = judge({drive, configured, result.facts, fitted, lag, speed});
  const Found& late = result.of(Quantity::position_late_s);
  if (late.refused.empty()) {
    const auto verdict = judge_speed(drive, chain, speed, late.interval / 2);
    result.speed_source = verdict.source;
    result.speed_source_refused = verdict.refused;
  } else {
    result.speed_source_refused = late.refused;
  }
  return result;
}

}  // namespace drover::calibrate
