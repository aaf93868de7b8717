// A map of characters: the track with whatever is put on it.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/track.h"

namespace drover::sim {

enum class Colour { none, dim, bold, red, green, yellow, blue };

/// One character, of any number of bytes.
struct Mark {
  Mark(const char* character, Colour c = Colour::none) : text(character), colour(c) {}
  Mark(std::string character, Colour c) : text(std::move(character)), colour(c) {}
  std::string text;
  Colour colour;
};

/// Beyond the edge nothing is drawn.
class MapSketch {
 public:
  /// North is up; the scale is the same in both directions (a character is twice as high as wide).
  explicit MapSketch(const std::vector<TrackPose>& track);
  void put(const TrackPose& place, const Mark& mark);
  /// From each point to the next.
  void put_way(const std::vector<TrackPose>& points, const Mark& mark);
  /// The edge of a closed polygon; of a small one the place it is at.
  void put_edge(const std::vector<TrackPose>& polygon, const Mark& mark);
  /// All of it; one that is less than two characters across is one character.
  void put_area(const std::vector<TrackPose>& polygon, const Mark& mark);
  /// Its name: inside where it is wide enough, beside it where nothing else is, or not at all.
  void put_name(const std::vector<TrackPose>& polygon, const std::string& name, Colour colour);
  /// Spaces at the end of a row are left out.
  std::vector<std::string> rows(bool coloured = false) const;
  /// A bar of a round length with its length: "|--------| 5 m".
  std::string scale() const;

 private:
  struct Extent {
    double west_m, east_m, south_m, north_m;
    double width_m() const { return east_m - west_m; }
    double height_m() const { return north_m - south_m; }
    TrackPose middle() const { return {(west_m + east_m) / 2, (south_m + north_m) / 2, 0}; }
  };
  static Extent extent(const std::vector<TrackPose>& points);
  double column(double x_m) const;
  double line(double y_m) const;
  void put_line(const TrackPose& from, const TrackPose& to, const Mark& mark);
  void write(double line, double column, const std::vector<std::string>& word, Colour colour);
  bool is_blank(double line, double column, std::size_t length) const;

  double west_m_ = 0;
  double north_m_ = 0;
  double cell_m_ = 1;  ///< width of a character
  std::vector<std::vector<Mark>> cells_;
};

/// The characters of a text in UTF-8; what is none counts by bytes.
std::vector<std::string> characters(const std::string& text);

/// One of eight arrows.
std::string arrow(double yaw_rad);

}  // namespace drover::sim
