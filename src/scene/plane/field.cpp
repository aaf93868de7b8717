#include "scene/plane/field.h"

#include <algorithm>

namespace drover::scene {
namespace {

template <class Objects>
auto find_name(Objects& objects, std::string_view name) {
  return std::lower_bound(
      objects.begin(), objects.end(), name,
      [](const auto& object, std::string_view wanted) { return object.first < wanted; });
}

}  // namespace

void Field::put(std::string name, Area area) {
  const auto found = find_name(objects_, name);
  const auto circle = circles_.begin() + (found - objects_.begin());
  if (found != objects_.end() && found->first == name) {
    *circle = area.around;
    found->second = std::move(area);
    return;
  }
  circles_.insert(circle, area.around);
  objects_.emplace(found, std::move(name), std::move(area));
}

bool Field::remove(std::string_view name) {
  const auto found = find_name(objects_, name);
  if (found == objects_.end() || found->first != name) return false;
  circles_.erase(circles_.begin() + (found - objects_.begin()));
  objects_.erase(found);
  return true;
}

const Area* Field::find(std::string_view name) const {
  const auto found = find_name(objects_, name);
  return found != objects_.end() && found->first == name ? &found->second : nullptr;
}

void Field::clear() {
  objects_.clear();
  circles_.clear();
}

}  // namespace drover::scene
