// Separating axes tell whether two convex polygons overlap; corners against edges tell how far
// apart they are.
#include "mission/judge.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

namespace drover::mission {
namespace {

/// The largest signed distance of all of `b` from an edge of `a`, outwards; -infinity: no edges.
double separation_m(const std::vector<Place>& a, const std::vector<Place>& b) {
  double widest_m = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size() && a.size() > 1; ++i) {
    const Place& p = a[i];
    const Place& q = a[(i + 1) % a.size()];
    const double length_m = distance_m(p, q);
    if (!(length_m > 0)) continue;
    double least_m = std::numeric_limits<double>::infinity();
    for (const auto& corner : b)
      least_m = std::min(least_m, ((corner.x_m - p.x_m) * (q.y_m - p.y_m) -
                                   (corner.y_m - p.y_m) * (q.x_m - p.x_m)) /
                                      length_m);
    widest_m = std::max(widest_m, least_m);
  }
  return widest_m;
}

double to_edge_m(const Place& a, const Place& b, const Place& at) {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  const double square = dx_m * dx_m + dy_m * dy_m;
  const double share =
      square > 0
          ? std::clamp(((at.x_m - a.x_m) * dx_m + (at.y_m - a.y_m) * dy_m) / square, 0.0, 1.0)
          : 0.0;
  return std::hypot(at.x_m - a.x_m - share * dx_m, at.y_m - a.y_m - share * dy_m);
}

double corners_to_edges_m(const std::vector<Place>& corners, const std::vector<Place>& edges) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& corner : corners)
    for (std::size_t i = 0; i < edges.size(); ++i)
      least_m = std::min(least_m, to_edge_m(edges[i], edges[(i + 1) % edges.size()], corner));
  return least_m;
}

std::vector<Place> turned(const std::vector<Place>& corners, double x_m, double y_m,
                          double yaw_rad) {
  std::vector<Place> out;
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  for (const auto& corner : corners)
    out.push_back({x_m + c * corner.x_m - s * corner.y_m, y_m + s * corner.x_m + c * corner.y_m});
  return out;
}

/// The largest radius between the heights, over the foot or the middle; none: not between them.
std::optional<double> radius_between_m(const TrueSolid& solid, double low_m, double top_m) {
  const double radius_m = solid.sizes.at(0);
  if (solid.kind == "sphere") {
    const double nearest_m = std::clamp(solid.z_m, low_m, top_m);
    const double off_m = std::abs(nearest_m - solid.z_m);
    if (!(off_m < radius_m)) return std::nullopt;
    return std::sqrt(radius_m * radius_m - off_m * off_m);
  }
  const double height_m = solid.sizes.at(1);
  const double foot_m = solid.z_m - height_m / 2;
  if (!(foot_m < top_m && foot_m + height_m > low_m)) return std::nullopt;
  if (solid.kind == "cylinder") return radius_m;
  return radius_m * std::min(1.0, (foot_m + height_m - low_m) / height_m);  // of a cone
}

using Present = std::map<std::string, TrueSolid>;

void apply(const ObjectLine& line, Present& present) {
  if (line.verb == "put") present[line.name] = line.solid;
  if (line.verb == "gone") present.erase(line.name);
  if (line.verb == "at") {
    auto& solid = present.at(line.name);
    solid.x_m = line.numbers.at(0);
    solid.y_m = line.numbers.at(1);
  }
}

Near near(const TruePose& pose, const std::string& name, const Flat& thing) {
  return {pose.time, name, gap_m(outline(pose.x_m, pose.y_m, pose.yaw_rad), thing), pose.moves()};
}

std::vector<Near> gaps(const TruePose& pose, const Present& present,
                       const std::vector<Fence>& fences) {
  std::vector<Near> found;
  for (const auto& [name, solid] : present)
    if (const auto thing = flat(solid)) found.push_back(near(pose, name, *thing));
  for (const auto& fence : fences)
    if (pose.time >= fence.begin && pose.time <= fence.end)
      found.push_back(near(pose, fence.name, fence.flat));
  std::sort(found.begin(), found.end(),
            [](const Near& a, const Near& b) { return a.gap_m < b.gap_m; });
  return found;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

double number_of(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    throw std::runtime_error("no number: '" + std::string(word) + "'");
  return value;
}

std::size_t sizes_of(std::string_view kind, std::size_t given) {
  if (kind == "box") return 3;
  if (kind == "cylinder" || kind == "cone") return 2;
  if (kind == "sphere") return 1;
  if (kind == "prism" && given >= 7 && given % 2 == 1) return given;
  throw std::runtime_error("no such solid: " + std::string(kind));
}

}  // namespace

double gap_m(const Flat& a, const Flat& b) {
  const double separation =
      std::max(separation_m(a.corners, b.corners), separation_m(b.corners, a.corners));
  double between_m = separation;
  if (!(separation < 0) || std::isinf(separation))
    between_m = std::min(corners_to_edges_m(a.corners, b.corners),
                         corners_to_edges_m(b.corners, a.corners));
  return between_m - a.radius_m - b.radius_m;
}

Flat outline(double x_m, double y_m, double yaw_rad, const RobotShape& robot) {
  return {turned({{robot.front_m, -robot.side_m},
                  {robot.front_m, robot.side_m},
                  {-robot.rear_m, robot.side_m},
                  {-robot.rear_m, -robot.side_m}},
                 x_m, y_m, yaw_rad),
          0};
}

std::optional<Flat> flat(const TrueSolid& solid, const RobotShape& robot) {
  if (solid.kind != "box" && solid.kind != "prism") {
    const auto radius_m = radius_between_m(solid, robot.low_m, robot.top_m);
    if (!radius_m) return std::nullopt;
    return Flat{{{solid.x_m, solid.y_m}}, *radius_m};
  }
  const double height_m = solid.kind == "box" ? solid.sizes.at(2) : solid.sizes.at(0);
  if (!(solid.z_m - height_m / 2 < robot.top_m && solid.z_m + height_m / 2 > robot.low_m))
    return std::nullopt;
  std::vector<Place> corners;
  if (solid.kind == "box") {
    const double x_m = solid.sizes.at(0) / 2;
    const double y_m = solid.sizes.at(1) / 2;
    corners = {{x_m, -y_m}, {x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}};
  } else {
    for (std::size_t i = 1; i + 1 < solid.sizes.size(); i += 2)
      corners.push_back({solid.sizes[i], solid.sizes[i + 1]});
  }
  return Flat{turned(corners, solid.x_m, solid.y_m, solid.yaw_rad), 0};
}

ObjectLine parse_object_line(std::string_view line) {
  const auto end = line.find(") ");
  const auto dot = line.find('.');
  if (line.empty() || line[0] != '(' || end == std::string_view::npos || dot + 10 != end)
    throw std::runtime_error("no stamp in '" + std::string(line) + "'");
  ObjectLine parsed;
  std::int64_t s = 0;
  std::int64_t ns = 0;
  const auto a = std::from_chars(line.data() + 1, line.data() + dot, s);
  const auto b = std::from_chars(line.data() + dot + 1, line.data() + end, ns);
  if (a.ptr != line.data() + dot || b.ptr != line.data() + end)
    throw std::runtime_error("no stamp in '" + std::string(line) + "'");
  parsed.time = Time{std::chrono::seconds(s) + Duration(ns)};
  const auto words = words_of(line.substr(end + 2));
  if (words.size() < 2) throw std::runtime_error("too few words in '" + std::string(line) + "'");
  parsed.verb = words[0];
  parsed.name = words[1];
  const std::size_t numbers_from = parsed.verb == "put" ? 3 : 2;
  for (std::size_t i = numbers_from; i < words.size(); ++i)
    parsed.numbers.push_back(number_of(words[i]));
  const auto expect = [&](std::size_t count) {
    if (parsed.numbers.size() != count)
      throw std::runtime_error("another number of numbers in '" + std::string(line) + "'");
  };
  if (parsed.verb == "put") {
    if (words.size() < 7) throw std::runtime_error("too few words in '" + std::string(line) + "'");
    const std::size_t sizes = parsed.numbers.size() - 4;
    expect(4 + sizes_of(words[2], sizes));
    const auto& n = parsed.numbers;
    parsed.solid = {parsed.name, std::string(words[2]),   n[0], n[1], n[2],
                    n[3],        {n.begin() + 4, n.end()}};
  } else if (parsed.verb == "at") {
    expect(2);
  } else if (parsed.verb == "touch") {
    expect(7);
  } else if (parsed.verb == "leave") {
    expect(3);
  } else if (parsed.verb == "gone" || parsed.verb == "watching") {
    expect(0);
  } else {
    throw std::runtime_error("unknown word in '" + std::string(line) + "'");
  }
  return parsed;
}

std::vector<Near> gaps_at(const TruePose& pose, const std::vector<ObjectLine>& objects,
                          const std::vector<Fence>& fences) {
  Present present;
  for (const auto& line : objects)
    if (line.time <= pose.time) apply(line, present);
  return gaps(pose, present, fences);
}

Verdict judge(const std::vector<TruePose>& poses, const std::vector<ObjectLine>& objects,
              const std::vector<Fence>& fences, Time begin, Time end) {
  Verdict verdict;
  Present present;
  auto next = objects.begin();
  for (const auto& pose : poses) {
    for (; next != objects.end() && next->time <= pose.time; ++next) apply(*next, present);
    if (pose.time < begin || pose.time > end) continue;
    ++verdict.poses;
    const auto found = gaps(pose, present, fences);
    verdict.things = std::max(verdict.things, found.size());
    if (found.empty()) continue;
    const Near& one = found.front();
    if (one.gap_m < verdict.nearest.gap_m) verdict.nearest = one;
    if (one.moving && one.gap_m < verdict.nearest_moving.gap_m) verdict.nearest_moving = one;
    if (!(one.gap_m < 0)) continue;
    if (!verdict.first) verdict.first = one;
    if (one.moving && !verdict.first_moving) verdict.first_moving = one;
  }
  return verdict;
}

}  // namespace drover::mission
