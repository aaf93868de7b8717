// Any objects around any sweep: no crash, no hang; what is not a number blocks everything; what a
// second opinion proves to overlap is never free; and what a sweep calls free is so at each pose.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "scene/plane/areas.h"
#include "scene/plane/overlap.h"
#include "scene/plane/sweep.h"
#include "tests/fuzz/input.h"
#include "tests/unit/scene/plane/witness.h"

namespace {

using namespace drover;
using namespace drover::scene;

constexpr double kFine_m = 1e-3;
constexpr std::size_t kMostObjects = 12;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Millimetres to both sides of 0, and now and then what nobody should send.
double number(fuzz::Input& input) {
  const std::uint16_t word = input.word();
  switch (word) {
    case 0x8000: return std::numeric_limits<double>::quiet_NaN();
    case 0x8001: return std::numeric_limits<double>::infinity();
    case 0x8002: return 1e9;
    case 0x8003: return 1e-9;
    default: return 1e-3 * static_cast<std::int16_t>(word);
  }
}

Pose read_pose(fuzz::Input& input) {
  Pose pose{{number(input), number(input), number(input)}, {}};
  if (input.byte() % 2 == 0) return pose;
  Quaternion q{number(input), number(input), number(input), number(input)};
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (length > 0) q = {q.w / length, q.x / length, q.y / length, q.z / length};
  pose.orientation = q;
  return pose;
}

bool all_finite(const Pose& pose) {
  const auto& [p, q] = pose;
  for (const double each : {p.x, p.y, p.z, q.w, q.x, q.y, q.z})
    if (!std::isfinite(each)) return false;
  return true;
}

struct Robot {
  std::vector<Point2> corners;
  double margin_m = 0;
  Pose2 at;
  Heights heights;
};

Robot read_robot(fuzz::Input& input) {
  Robot robot;
  const auto side_m = [&] { return 0.05 + 0.005 * input.byte(); };
  const double ahead_m = side_m();
  const double back_m = side_m();
  const double half_m = side_m();
  robot.corners = {{-back_m, -half_m}, {ahead_m, -half_m}, {ahead_m, half_m}, {-back_m, half_m}};
  robot.margin_m = 2 * kFine_m + 1e-3 * input.byte();
  robot.at = {number(input), number(input), number(input)};
  robot.heights.low_m = 0.002 * input.byte();
  robot.heights.high_m = robot.heights.low_m + 0.01 + 0.01 * input.byte();
  return robot;
}

/// Smaller by a millimetre on all sides.
witness::Robot smaller(const Robot& robot) {
  witness::Robot smaller;
  const double c = std::cos(robot.at.yaw_rad);
  const double s = std::sin(robot.at.yaw_rad);
  for (const Point2 p : robot.corners)
    smaller.footprint.corners.push_back(
        {robot.at.x_m + c * p.x_m - s * p.y_m, robot.at.y_m + s * p.x_m + c * p.y_m});
  smaller.margin = robot.margin_m - kFine_m;
  smaller.low = robot.heights.low_m + kFine_m;
  smaller.high = robot.heights.high_m - kFine_m;
  return smaller;
}

bool blocks_everything(const Area& area) {
  return overlaps(disc({-1e7, 1e7}, 0), area) && overlaps(disc({3, -1e7}, 0), area);
}

Area read_primitive(fuzz::Input& input, const Robot& robot) {
  SolidPrimitive shape;
  shape.type = static_cast<std::uint8_t>(input.byte() % 6);
  const std::size_t count = shape.type == SolidPrimitive::BOX      ? 3
                            : shape.type == SolidPrimitive::SPHERE ? 1
                                                                   : 2;
  bool sound = shape.type >= 1 && shape.type <= 4;
  for (std::size_t i = 0; i < count; ++i) {
    shape.dimensions.push_back(number(input));
    sound = sound && std::isfinite(shape.dimensions.back()) && shape.dimensions.back() > 0;
  }
  const Pose pose = read_pose(input);
  const Area area = area_of(shape, pose, robot.heights);
  if (!sound || !all_finite(pose)) {
    require(blocks_everything(area));
  } else if (is_finite(robot.at) && std::abs(robot.at.x_m) < 100) {
    const auto verdict = judge(witness::Body{shape, pose}, smaller(robot));
    const bool hit = overlaps(placed(piece_of(robot.corners, robot.margin_m), robot.at), area);
    require(hit || verdict != witness::Verdict::overlap);
  }
  return area;
}

Area read_mesh(fuzz::Input& input, const Robot& robot) {
  Mesh mesh;
  for (std::size_t i = input.byte() % 10; i > 0; --i)
    mesh.vertices.push_back({number(input), number(input), number(input)});
  bool sound = true;
  for (std::size_t i = input.byte() % 17; i > 0; --i) {
    mesh.triangles.push_back({input.byte() % 10U, input.byte() % 10U, input.byte() % 10U});
    for (const std::uint32_t index : mesh.triangles.back())
      sound = sound && index < mesh.vertices.size();
  }
  for (const Vector3& v : mesh.vertices)
    sound = sound && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  const Pose pose = read_pose(input);
  const Area area = area_of(mesh, pose, robot.heights);
  if (!sound || !all_finite(pose)) require(blocks_everything(area));
  return area;
}

std::vector<std::vector<Point2>> read_rings(fuzz::Input& input) {
  std::vector<std::vector<Point2>> rings(1 + input.byte() % 2);
  for (auto& ring : rings)
    for (std::size_t i = input.byte() % 9; i > 0; --i)
      ring.push_back({number(input), number(input)});
  return rings;
}

Area read_area(fuzz::Input& input, const Robot& robot) {
  switch (input.byte() % 8) {
    case 0: return read_mesh(input, robot);
    case 1: {
      const Plane plane{{number(input), number(input), number(input), number(input)}};
      return area_of(plane, read_pose(input), robot.heights);
    }
    case 2: return area_of_rings(read_rings(input));
    case 3: return union_of({read_primitive(input, robot), read_mesh(input, robot)});
    default: return read_primitive(input, robot);
  }
}

std::vector<Step> read_steps(fuzz::Input& input, const Robot& robot) {
  const double stride = stride_m(piece_of(robot.corners, robot.margin_m));
  const auto kind = input.byte() % 4;
  // Nobody sweeps further than a stopping distance or a track; the bound of the length is tested
  // elsewhere.
  const auto length_m = [&] { return std::remainder(number(input), 4.0); };
  if (kind == 0) return pivot_steps(robot.at, number(input));
  if (kind == 1) return arc_steps(robot.at, length_m(), number(input), stride);
  if (kind == 2) return twist_steps(robot.at, number(input), number(input), length_m(), stride);
  std::vector<Point2> line;
  for (std::size_t i = input.byte() % 6; i > 0; --i)
    line.push_back({robot.at.x_m + length_m(), robot.at.y_m + length_m()});
  return track_steps(robot.at, line, stride);
}

bool same(const FreeWay& a, const FreeWay& b) {
  return a.free_m == b.free_m && a.free_rad == b.free_rad && a.blocked == b.blocked &&
         a.at_start == b.at_start && a.object == b.object;
}

void check_sweep(const Field& field, const Piece& footprint, std::span<const Step> steps) {
  const FreeWay way = first_contact(field, footprint, steps);
  require(same(way, first_contact(field, footprint, steps)));
  const auto hits_any = [&](const Pose2& pose) {
    const Piece body = placed(footprint, pose);
    for (std::size_t i = 0; i < field.size(); ++i)
      if (overlaps(body, field.area(i))) return true;
    return false;
  };
  require(way.at_start == (!is_finite(steps.front().pose) || hits_any(steps.front().pose)));
  if (way.at_start) return;
  require(!hits_any(way.pose));
  for (const Step& step : steps) {
    const bool beyond = step.driven_m > way.free_m || step.turned_rad > way.free_rad;
    if (way.blocked && (beyond || !is_finite(step.pose))) break;
    require(is_finite(step.pose) && !hits_any(step.pose));
  }
}

void check_keep_in(const Area& zone, const Piece& footprint, std::span<const Step> steps) {
  const FreeWay way = first_exit(std::span(&zone, 1), footprint, steps);
  require(way.at_start == !is_inside(zone, placed(footprint, steps.front().pose)));
  if (!way.at_start) require(is_inside(zone, placed(footprint, way.pose)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  const Robot robot = read_robot(input);
  const std::vector<Step> steps = read_steps(input, robot);
  const Piece footprint = piece_of(robot.corners, robot.margin_m);
  check_keep_in(area_of_rings(read_rings(input)), footprint, steps);
  Field field;
  while (input.more() && field.size() < kMostObjects)
    field.put(std::to_string(field.size()), read_area(input, robot));
  check_sweep(field, footprint, steps);
  return 0;
}
