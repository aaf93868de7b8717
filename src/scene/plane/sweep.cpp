#include "scene/plane/sweep.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scene/plane/overlap.h"

namespace drover::scene {
namespace {

/// For so many steps at once it is looked up what is near.
constexpr std::size_t kStepsTogether = 16;

/// The farthest that a point of the footprint has from its place at one pose to that at the other:
/// it is a corner, since a turn and a move are linear.
double longest_chord_m(const Piece& from, const Piece& to) {
  double longest2 = 0;
  const std::size_t count = std::min(from.corners.size(), to.corners.size());
  for (std::size_t i = 0; i < count; ++i)
    longest2 = std::max(longest2, squared(to.corners[i] - from.corners[i]));
  return std::sqrt(longest2);
}

/// Of what lies between two steps, and of what the robot may be beside them.
Piece passed(const Piece& footprint, const Step& from, const Step& to) {
  return widened(swept(footprint, from.pose, to.pose), std::max(from.off_m, to.off_m));
}

/// Around the footprint at all these steps and between them.
Circle circle_of(const Piece& footprint, std::span<const Step> steps) {
  Circle circle = passed(footprint, steps.front(), steps.back()).around;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const Circle part = passed(footprint, steps[i], steps[i + 1]).around;
    circle.radius_m =
        std::max(circle.radius_m, length_m(part.centre - circle.centre) + part.radius_m);
  }
  return circle;
}

/// What of an area can be met within a circle.
struct Near {
  std::size_t object = 0;
  const Area* area = nullptr;
  std::vector<const Piece*> pieces;
};

Near near_part(std::size_t object, const Area& area, const Circle& circle) {
  Near near{object, &area, {}};
  for (const Piece& piece : area.pieces)
    if (!apart(piece.around, circle)) near.pieces.push_back(&piece);
  return near;
}

bool touches_piece(const Near& near, const Piece& body) {
  return std::any_of(near.pieces.begin(), near.pieces.end(),
                     [&](const Piece* piece) { return overlaps(body, *piece); });
}

/// Judges bodies near some steps against the objects of a field.
class Obstacles {
 public:
  explicit Obstacles(const Field& field) : field_(field) {}

  void look_around(const Circle& circle) {
    near_.clear();
    for (std::size_t i = 0; i < field_.size(); ++i)
      if (!apart(field_.circles()[i], circle))
        near_.push_back(near_part(i, field_.area(i), circle));
  }
  std::optional<std::size_t> in_the_way_of(const Piece& body) {
    for (const Near& near : near_)
      if (meets(near, body)) return near.object;
    return std::nullopt;
  }
  Point2 nearest_to(std::size_t object, Point2 from) const {
    return nearest(field_.area(object), from);
  }

 private:
  static bool meets(const Near& near, const Piece& body) {
    const Area& area = *near.area;
    if (area.empty() || apart(area.around, body.around)) return false;
    return std::any_of(area.strips.begin(), area.strips.end(),
                       [&](const Strip& strip) { return overlaps(body, strip); }) ||
           touches_piece(near, body) || is_inside(area, body.corners.front());
  }

  const Field& field_;
  std::vector<Near> near_;
};

/// The same for zones that have to be kept to.
class Fences {
 public:
  explicit Fences(std::span<const Area> zones) : zones_(zones) {}

  void look_around(const Circle& circle) {
    near_.clear();
    for (std::size_t i = 0; i < zones_.size(); ++i)
      if (!apart(zones_[i].around, circle)) near_.push_back(near_part(i, zones_[i], circle));
  }
  std::optional<std::size_t> in_the_way_of(const Piece& body) {
    if (zones_.empty()) return std::nullopt;
    for (const Near& near : near_) {
      if (touches_piece(near, body) || !is_inside(*near.area, body.corners.front())) continue;
      last_ = near.object;
      return std::nullopt;
    }
    return last_;
  }
  /// The fence itself, not what is behind it.
  Point2 nearest_to(std::size_t zone, Point2 from) const {
    Area fence;
    if (zone < zones_.size()) fence = area_of(zones_[zone].pieces);
    return fence.empty() ? from : nearest(fence, from);
  }

 private:
  std::span<const Area> zones_;
  std::vector<Near> near_;
  std::size_t last_ = 0;  ///< the zone that the body was in
};

template <class Judge>
std::optional<std::size_t> judged(Judge& judge, const Piece& body) {
  if (!std::isfinite(body.around.radius_m)) return kNoObject;
  return judge.in_the_way_of(body);
}

struct Contact {
  Step last_free;
  std::size_t object = 0;
};

/// The hull of a step takes a little more than what is passed, so a step that is blocked may be
/// free in halves; what is still blocked at the resolution is a contact.
template <class Judge>
std::optional<Contact> find_contact(Judge& judge, const Piece& footprint, const Step& from,
                                    const Step& to) {
  const auto object = judged(judge, passed(footprint, from, to));
  if (!object) return std::nullopt;
  const double chord_m = longest_chord_m(placed(footprint, from.pose), placed(footprint, to.pose));
  if (*object == kNoObject || !(chord_m > kResolution_m)) return Contact{from, *object};
  const Step middle{between(from.pose, to.pose, 0.5), 0.5 * (from.driven_m + to.driven_m),
                    0.5 * (from.turned_rad + to.turned_rad), 0.5 * (from.off_m + to.off_m)};
  const auto first = find_contact(judge, footprint, from, middle);
  return first ? first : find_contact(judge, footprint, middle, to);
}

template <class Judge>
FreeWay blocked_at(const Judge& judge, const Piece& footprint, const Contact& contact) {
  const Step& last = contact.last_free;
  FreeWay way{last.driven_m, last.turned_rad, last.pose, true, false, contact.object, {}};
  const Point2 centre = placed(footprint, last.pose).around.centre;
  way.where =
      contact.object == kNoObject ? place_of(last.pose) : judge.nearest_to(contact.object, centre);
  return way;
}

template <class Judge>
FreeWay walk(Judge judge, const Piece& footprint, std::span<const Step> steps) {
  if (steps.empty()) return {};
  judge.look_around(circle_of(footprint, steps.first(1)));
  const Step& first = steps.front();
  if (const auto object = judged(judge, widened(placed(footprint, first.pose), first.off_m))) {
    FreeWay way = blocked_at(judge, footprint, {first, *object});
    way.at_start = true;
    return way;
  }
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (i % kStepsTogether == 0) {
      const std::size_t count = std::min(kStepsTogether + 1, steps.size() - i);
      judge.look_around(circle_of(footprint, steps.subspan(i, count)));
    }
    if (const auto contact = find_contact(judge, footprint, steps[i], steps[i + 1]))
      return blocked_at(judge, footprint, *contact);
  }
  const Step& last = steps.back();
  return {last.driven_m, last.turned_rad, last.pose, false, false, 0, {}};
}

}  // namespace

Piece swept(const Piece& footprint, const Pose2& from, const Pose2& to) {
  if (!is_finite(from) || !is_finite(to)) return piece_of_everything();
  const Piece first = placed(footprint, from);
  const Piece last = placed(footprint, to);
  // A chord of length c under an arc that turns by a has the sagitta c / 2 tan(a / 4).
  const double turn_rad = std::abs(wrap_rad(to.yaw_rad - from.yaw_rad));
  const double sagitta_m = 0.5 * longest_chord_m(first, last) * std::tan(0.25 * turn_rad);
  std::vector<Point2> corners = first.corners;
  corners.insert(corners.end(), last.corners.begin(), last.corners.end());
  return piece_of(std::move(corners), footprint.radius_m + sagitta_m);
}

FreeWay first_contact(const Field& field, const Piece& footprint, std::span<const Step> steps) {
  return walk(Obstacles(field), footprint, steps);
}

FreeWay first_exit(std::span<const Area> keep_in, const Piece& footprint,
                   std::span<const Step> steps) {
  return walk(Fences(keep_in), footprint, steps);
}

}  // namespace drover::scene
