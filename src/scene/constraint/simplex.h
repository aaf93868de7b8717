// A point, line, triangle or tetrahedron, and the point of it that is nearest to the origin.
#pragma once

#include <array>
#include <cstddef>

#include "drover/measurement.h"

namespace drover::scene {

class Simplex final {
 public:
  struct Nearest {
    Vector3 point;
    bool encloses = false;  ///< the origin is inside a tetrahedron with a volume
  };

  /// False when the corner is there already: nothing new is to be learnt.
  bool add(const Vector3& corner);
  /// Forgets the corners that the nearest point does not lean on. There is a corner.
  Nearest reduce_to_nearest();

 private:
  std::array<Vector3, 4> corners_{};
  std::size_t size_ = 0;
};

}  // namespace drover::scene
