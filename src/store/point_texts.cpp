// A track's numbers in their own spelling: what came is what is stored and given back.
#include "store/point_texts.h"

#include <algorithm>
#include <cmath>

#include "json/json_text.h"

namespace drover::store {
namespace {

/// `{"angle":,"latitude":,"longitude":,"x":,"y":,"yaw":,"z":},`
constexpr std::size_t kPointFrame = 58;
/// `{"data":[],"name":},`
constexpr std::size_t kTrackFrame = 20;
/// x and y may have to be written anew for another origin: "-1234.5678", "-1234567.8".
constexpr std::size_t kLongestPlace = 10;

}  // namespace

void append_point(std::string& numbers, const PointText& point) {
  for (const auto number : point) {
    numbers += number;
    numbers += ',';
  }
}

bool PointTexts::next(PointText& point) {
  if (index_ >= track_.points.size()) return false;
  const TrackPoint& values = track_.points[index_++];
  if (track_.numbers.empty()) {
    spell(values, point);
    return true;
  }
  for (auto& number : point) {
    const auto comma = std::min(rest_.find(','), rest_.size());
    number = rest_.substr(0, comma);
    rest_.remove_prefix(std::min(comma + 1, rest_.size()));
  }
  return true;
}

void PointTexts::spell(const TrackPoint& point, PointText& text) {
  json::JsonText out;
  for (const double value : {point.longitude_deg, point.latitude_deg, point.angle_deg, point.x_m,
                             point.y_m, point.yaw_rad, point.z_m})
    out.number(value);
  spelled_ = out.take();
  std::string_view rest = spelled_;
  for (auto& number : text) {
    number = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(number.size() + 1, rest.size()));
  }
}

std::string place_text(double metres) {
  // Tenths of a millimetre are finer than any track; far away they would only be long.
  const double size_m = std::abs(metres);
  const int decimals = size_m < 9999 ? 4 : size_m < 99'999 ? 3 : size_m < 999'999 ? 2 : 1;
  return json::JsonText().number(metres, size_m < 9'999'999 ? decimals : 0).take();
}

std::size_t list_bytes(const Track& track) {
  std::size_t bytes = kTrackFrame + json::JsonText().text(track.name).str().size();
  PointTexts texts(track);
  for (PointText point; texts.next(point);) {
    bytes += kPointFrame;
    for (std::size_t i = 0; i < point.size(); ++i)
      bytes += i == kX || i == kY ? std::max(point[i].size(), kLongestPlace) : point[i].size();
  }
  return bytes;
}

}  // namespace drover::store
