// What a sweep through the planning scene costs: twenty poses along an arc of 2 m among 10 to
// 10 000 objects, and what it costs to take a mesh into the plane.
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "scene/look/look.h"
#include "scene/plane/areas.h"
#include "scene/plane/sweep.h"

namespace drover::scene {
namespace {

constexpr Heights kRobot{0.05, 0.6};

Piece footprint() {
  return piece_of({{-0.45, -0.35}, {0.45, -0.35}, {0.45, 0.35}, {-0.45, 0.35}}, 0.05);
}
std::vector<Step> twenty_poses() {
  return arc_steps({0, 0, 0}, 2, 0.5, 2.0 / 19);
}

/// Boxes, spheres, cylinders and cones by turns, anywhere in a square field about the robot.
Field field_of(std::size_t objects, double side_m) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> at_m(-0.5 * side_m, 0.5 * side_m);
  std::uniform_real_distribution<> size_m(0.05, 0.3);
  Field field;
  while (field.size() < objects) {
    SolidPrimitive shape;
    shape.type = static_cast<std::uint8_t>(1 + field.size() % 4);
    shape.dimensions = {size_m(random), size_m(random), size_m(random)};
    const Pose pose{{at_m(random), at_m(random), 0.2}, {}};
    field.put(std::to_string(field.size()), area_of(shape, pose, kRobot));
  }
  return field;
}

/// The same field without what touches the way, so that the whole of it is swept.
Field field_beside(std::size_t objects, double side_m) {
  Field field = field_of(objects, side_m);
  const auto steps = twenty_poses();
  for (FreeWay way = first_contact(field, footprint(), steps); way.blocked;
       way = first_contact(field, footprint(), steps))
    field.put(field.name(way.object), Area{});
  return field;
}

void sweep(benchmark::State& state, const Field& field) {
  const auto steps = twenty_poses();
  const Piece body = footprint();
  for ([[maybe_unused]] auto each : state)
    benchmark::DoNotOptimize(first_contact(field, body, steps));
}

/// All objects in 16 m; most are far.
void free_sweep_in_16_m(benchmark::State& state) {
  sweep(state, field_beside(static_cast<std::size_t>(state.range(0)), 16));
}
BENCHMARK(free_sweep_in_16_m)->Arg(10)->Arg(100)->Arg(1000)->Arg(10'000);

/// All objects in 8 m: a robot in a thicket, through a lane that is just free.
void free_sweep_in_8_m(benchmark::State& state) {
  sweep(state, field_beside(static_cast<std::size_t>(state.range(0)), 8));
}
BENCHMARK(free_sweep_in_8_m)->Arg(10)->Arg(100)->Arg(1000)->Arg(10'000);

void blocked_sweep_in_16_m(benchmark::State& state) {
  sweep(state, field_of(static_cast<std::size_t>(state.range(0)), 16));
}
BENCHMARK(blocked_sweep_in_16_m)->Arg(10)->Arg(100)->Arg(1000)->Arg(10'000);

/// A turn of a lidar: points on a wall 0.6 m beside the way.
void sweep_beside_points(benchmark::State& state) {
  std::vector<Piece> points;
  for (int i = 0; i < state.range(0); ++i) points.push_back(disc({0.01 * i - 2, -0.6}, 0.02));
  Field field;
  field.put("scan", area_of(std::move(points)));
  sweep(state, field);
}
BENCHMARK(sweep_beside_points)->Arg(455);

/// A closed ball of 1 m of so many triangles.
Mesh ball_of(std::int64_t triangles) {
  const auto round = static_cast<std::uint32_t>(std::sqrt(0.5 * static_cast<double>(triangles)));
  Mesh ball;
  for (std::uint32_t k = 0; k <= round; ++k)
    for (std::uint32_t i = 0; i < round; ++i) {
      const double up_rad = kPi * k / round;
      const Point2 at = std::sin(up_rad) * direction(2 * kPi * i / round);
      ball.vertices.push_back({at.x_m, at.y_m, std::cos(up_rad)});
    }
  for (std::uint32_t k = 0; k < round; ++k)
    for (std::uint32_t i = 0; i < round; ++i) {
      const std::uint32_t a = k * round + i;
      const std::uint32_t b = k * round + (i + 1) % round;
      ball.triangles.push_back({a, a + round, b});
      ball.triangles.push_back({b, a + round, b + round});
    }
  return ball;
}

/// What it takes to cut it by the robot's heights.
void area_of_mesh(benchmark::State& state) {
  const Mesh ball = ball_of(state.range(0));
  for ([[maybe_unused]] auto each : state) benchmark::DoNotOptimize(area_of(ball, Pose{}, kRobot));
}
BENCHMARK(area_of_mesh)->Arg(1000)->Arg(10'000);

/// All of its triangles in reach of the way, 5 cm beside it.
void sweep_beside_mesh(benchmark::State& state) {
  Field field;
  field.put("ball", area_of(ball_of(state.range(0)), Pose{{1, -1.45, 0.3}, {}}, kRobot));
  sweep(state, field);
}
BENCHMARK(sweep_beside_mesh)->Arg(1000)->Arg(10'000);

/// A whole look: along a track of 10 m, ahead, back and around, every 50 ms at work.
void look_in_8_m(benchmark::State& state) {
  Surroundings around;
  around.problem.clear();
  around.field = field_beside(static_cast<std::size_t>(state.range(0)), 8);
  LookSettings settings;
  settings.footprint = {{-0.45, -0.35}, {0.45, -0.35}, {0.45, 0.35}, {-0.45, 0.35}};
  settings.margin_m = 0.05;
  // Round and round in what field_beside has left free.
  std::vector<Point2> line;
  for (int i = 0; i <= 20; ++i)
    line.push_back({4 * std::sin(0.125 * i), 4 - 4 * std::cos(0.125 * i)});
  Standpoint from;
  from.path = 1;
  from.line = line;
  from.twist = {0.5, 0.125};
  for ([[maybe_unused]] auto each : state) benchmark::DoNotOptimize(look(around, settings, from));
}
BENCHMARK(look_in_8_m)->Arg(10)->Arg(100)->Arg(1000)->Arg(10'000);

/// The most that a look can cost: all of it free, though a thousand objects are near.
void look_among_poles(benchmark::State& state) {
  Surroundings around;
  around.problem.clear();
  std::mt19937 random(1);
  std::uniform_real_distribution<> at_m(-4, 4);
  while (around.field.size() < static_cast<std::size_t>(state.range(0))) {
    const Point2 at{at_m(random), at_m(random)};
    if (std::abs(at.y_m) < 0.75) continue;
    around.field.put(std::to_string(around.field.size()), area_of({disc(at, 0.02)}));
  }
  LookSettings settings;
  settings.footprint = {{-0.45, -0.35}, {0.45, -0.35}, {0.45, 0.35}, {-0.45, 0.35}};
  const std::vector<Point2> line{{0, 0}, {20, 0}};
  Standpoint from;
  from.path = 1;
  from.line = line;
  for ([[maybe_unused]] auto each : state) benchmark::DoNotOptimize(look(around, settings, from));
}
BENCHMARK(look_among_poles)->Arg(100)->Arg(1000)->Arg(10'000);

}  // namespace
}  // namespace drover::scene

BENCHMARK_MAIN();
