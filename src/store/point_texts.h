// A track's numbers in their own spelling: what came is what is stored and given back.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "store/track.h"

namespace drover::store {

inline constexpr std::size_t kNumbersPerPoint = 7;
/// Longitude, latitude, angle, x, y, yaw, z: the order of TrackPoint's fields. JSON numbers.
using PointText = std::array<std::string_view, kNumbersPerPoint>;
inline constexpr std::size_t kX = 3;
inline constexpr std::size_t kY = 4;
inline constexpr std::size_t kZ = 6;

/// Appends a point to `Track::numbers`.
void append_point(std::string& numbers, const PointText& point);

/// Walks over the points of a track that outlives it.
class PointTexts final {
 public:
  explicit PointTexts(const Track& track) : track_(track), rest_(track.numbers) {}
  /// False behind the last one. `point` holds until the next call.
  bool next(PointText& point);

 private:
  void spell(const TrackPoint& point, PointText& text);

  const Track& track_;
  std::string_view rest_;
  std::size_t index_ = 0;
  std::string spelled_;  ///< of the present point, when the track has no spelling
};

/// An x or y that was calculated: at most 10 characters on this earth.
std::string place_text(double metres);

/// How many bytes the track may take in a list of tracks, under any origin.
std::size_t list_bytes(const Track& track);

}  // namespace drover::store
