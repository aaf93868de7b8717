// What an import of a zone gives: polygons, or the place in the file that is wrong.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/zone/zone.h"

namespace drover::scene {

/// What the file says; whether it is keep-in or keep-out the person says who imports it.
struct ImportedZone {
  std::string name;  ///< of the file's areas, when they agree; else empty
  bool names_differ = false;
  std::vector<GeoPolygon> polygons;  ///< as check_polygons wants them
  std::vector<std::string> notes;    ///< what was passed over, a sentence each
};

struct ImportError {
  std::size_t line = 0;    ///< from 1; 0: not known
  std::size_t column = 0;  ///< from 1; 0: not known
  std::string path;        ///< of the value or element; empty: the file as a whole
  std::string what;
  /// "line 3, column 7 (features[0].geometry): ..."
  std::string text() const;
};

inline constexpr std::size_t kMaxImportBytes = std::size_t{2} << 20;

}  // namespace drover::scene
