// All that stands around the robot, by name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/plane/area.h"

namespace drover::scene {

/// Objects in the order of their names, so that equal scenes give equal answers however they came
/// to be. An index holds until the next put or remove.
class Field final {
 public:
  /// Replaces what has this name. Objects that take nothing of the plane may be in it, too.
  void put(std::string name, Area area);
  bool remove(std::string_view name);
  /// nullptr: there is none of this name. It holds until the next put or remove.
  const Area* find(std::string_view name) const;
  void clear();

  std::size_t size() const { return objects_.size(); }
  const std::string& name(std::size_t index) const { return objects_[index].first; }
  const Area& area(std::size_t index) const { return objects_[index].second; }
  /// In the same order, close together: it is walked through for every few steps of a sweep.
  const std::vector<Circle>& circles() const { return circles_; }

 private:
  std::vector<std::pair<std::string, Area>> objects_;
  std::vector<Circle> circles_;
};

}  // namespace drover::scene
