// What a scenario puts in the robot's way, and what the robot touches.
#include <algorithm>

#include "sim/plant/plant_impl.h"

namespace drover::sim {

std::size_t Plant::object_slots() const {
  return impl_->objects->slots();
}

std::string Plant::put_object(std::string_view name, const Solid& solid) {
  return impl_->objects->put(*impl_->model, *impl_->data, name, solid);
}

bool Plant::move_object(std::string_view name, double x_m, double y_m, double speed_mps) {
  return impl_->objects->move(name, x_m, y_m, speed_mps);
}

bool Plant::remove_object(std::string_view name) {
  return impl_->objects->remove(*impl_->data, name);
}

double Plant::ground_m(double x_m, double y_m) const {
  return impl_->ground_m(x_m, y_m);
}

std::vector<Plant::PlacedObject> Plant::objects() const {
  std::vector<PlacedObject> placed;
  for (auto& one : impl_->objects->placed())
    placed.push_back({std::move(one.name), std::move(one.solid), one.moves});
  return placed;
}

const std::vector<Plant::Touch>& Plant::touches() const {
  return impl_->touches;
}

bool Plant::Impl::is_body(int geom) const {
  return std::find(body_geoms.begin(), body_geoms.end(), geom) != body_geoms.end();
}

// Several contacts with one thing are one touch, as deep as the deepest.
void Plant::Impl::feel() {
  touches.clear();
  for (int i = 0; i < data->ncon; ++i) {
    const mjContact& contact = data->contact[i];
    const bool first = is_body(contact.geom1);
    if (!first && !is_body(contact.geom2)) continue;
    const int other = first ? contact.geom2 : contact.geom1;
    std::string_view what = objects->name_of(other);
    if (what.empty()) {
      const char* name = mj_id2name(model.get(), mjOBJ_GEOM, other);
      if (name == nullptr) name = mj_id2name(model.get(), mjOBJ_BODY, model->geom_bodyid[other]);
      what = name == nullptr ? "something" : name;
    }
    const double depth_m = std::max(0.0, -contact.dist);
    const auto known = std::find_if(touches.begin(), touches.end(),
                                    [what](const Touch& touch) { return touch.what == what; });
    if (known != touches.end()) {
      known->depth_m = std::max(known->depth_m, depth_m);
    } else if (touches.size() < kMaxBoxes) {
      touches.push_back({what, depth_m});
    }
  }
}

}  // namespace drover::sim
