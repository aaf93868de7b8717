#include <gtest/gtest.h>

#include <random>

#include "drover/angle.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

/// Open to the right: arms of 0.5 m above and below a mouth of 1 m, in a block of 2 m.
Mesh horseshoe(double low_m, double high_m) {
  Mesh whole;
  const auto add = [&](const std::vector<Point2>& ring) {
    const Mesh part = pulled_up(ring, low_m, high_m);
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const MeshTriangle& t : part.triangles)
      whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  };
  // A U is not star-shaped about a corner: three boxes that share walls.
  add({{-1, -1}, {1, -1}, {1, -0.5}, {-1, -0.5}});
  add({{-1, 0.5}, {1, 0.5}, {1, 1}, {-1, 1}});
  add({{-1, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}, {-1, 0.5}});
  return whole;
}

TEST(MeshAreas, TheMouthOfAConcaveOneIsFree) {
  const Area area = area_of(horseshoe(0, 1), {}, kRobot);
  const auto body = [](double x_m) { return placed(footprint(), {x_m, 0, 0}); };
  EXPECT_FALSE(overlaps(body(0), area));
  EXPECT_FALSE(overlaps(body(1), area));
  EXPECT_TRUE(overlaps(body(-0.06), area)) << "its back at -0.51 m touches the bottom of the U";
  EXPECT_TRUE(covers(area, -0.75, 0));
  EXPECT_TRUE(covers(area, 0.5, 0.75));
  EXPECT_FALSE(covers(area, 0.5, 0.49));
}

TEST(MeshAreas, TheInsideOfAClosedOneIsSolid) {
  const Area area = area_of(box_mesh(5, -1, 2), {}, kRobot);
  EXPECT_TRUE(overlaps(placed(footprint(), {0, 0, 0.3}), area));
  EXPECT_TRUE(overlaps(placed(footprint(), {4, -4, 0.3}), area));
  EXPECT_FALSE(overlaps(placed(footprint(), {6, 0, 0}), area));
}

TEST(MeshAreas, AClosedOneThatEndsInTheIntervalIsSolidUnderItsLid) {
  EXPECT_TRUE(covers(area_of(box_mesh(5, -1, 0.3), {}, kRobot), 0.1, 0.2));
  EXPECT_TRUE(covers(area_of(box_mesh(5, 0.3, 2), {}, kRobot), 0.1, 0.2));
  EXPECT_TRUE(area_of(box_mesh(5, -1, 0.05), {}, kRobot).empty());
  EXPECT_TRUE(area_of(box_mesh(5, 0.6, 2), {}, kRobot).empty());
}

TEST(MeshAreas, TheInsideOfAnOpenOneIsFreeAndItsWallsAreNot) {
  Mesh open = box_mesh(5, -1, 2);
  open.triangles.pop_back();
  const Area area = area_of(open, {}, kRobot);
  EXPECT_FALSE(overlaps(placed(footprint(), {0, 0, 0}), area));
  EXPECT_TRUE(overlaps(placed(footprint(), {4.6, 0, 0}), area));
}

TEST(MeshAreas, OneWhoseTrianglesShareNoCornersIsClosedTheSame) {
  const Mesh shared = box_mesh(5, -1, 2);
  Mesh apart;
  for (const MeshTriangle& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.vertices.size());
    for (const std::uint32_t corner : t) apart.vertices.push_back(shared.vertices[corner]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(covers(area_of(apart, {}, kRobot), 0, 0));
}

TEST(MeshAreas, OneWithATriangleTurnedTheOtherWayIsSolidTooAndNothingElseIs) {
  for (std::size_t turned = 0; turned < 12; ++turned) {
    Mesh mesh = box_mesh(5, -1, 2);
    std::swap(mesh.triangles[turned][0], mesh.triangles[turned][1]);
    const Area area = area_of(mesh, {}, kRobot);
    for (const double y_m : {-2.5, 2.5}) {
      EXPECT_TRUE(covers(area, 0, y_m)) << turned;
      EXPECT_FALSE(covers(area, -6, y_m)) << turned;
    }
  }
}

TEST(MeshAreas, TwoBlocksInOneThatOverlapDoNotCancelEachOther) {
  Mesh mesh = box_mesh(5, -1, 2);
  const Mesh inner = box_mesh(4, -1, 2);
  for (const Vector3& v : inner.vertices) mesh.vertices.push_back({v.x + 2, v.y, v.z});
  for (const MeshTriangle& t : inner.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_TRUE(overlaps(placed(footprint(), {1.5, 0, 0}), area_of(mesh, {}, kRobot)));
}

TEST(MeshAreas, ARoomInAClosedOneIsFree) {
  // The inner skin is turned towards the room, as a solid with a hole has it.
  Mesh mesh = box_mesh(5, -1, 2);
  const Mesh room = box_mesh(4, -0.5, 1.5);
  mesh.vertices.insert(mesh.vertices.end(), room.vertices.begin(), room.vertices.end());
  for (const MeshTriangle& t : room.triangles)
    mesh.triangles.push_back({t[1] + 8, t[0] + 8, t[2] + 8});
  const Area area = area_of(mesh, {}, kRobot);
  EXPECT_FALSE(covers(area, 0, 0));
  EXPECT_TRUE(covers(area, 4.5, 0));
}

TEST(MeshAreas, AFlatSheetAtTheHeightOfTheRobotIsInItsWay) {
  const Mesh table{{{0, 1, 2}, {0, 2, 3}},
                   {{-1, -1, 0.3}, {1, -1, 0.3}, {1, 1, 0.3}, {-1, 1, 0.3}}};
  EXPECT_TRUE(covers(area_of(table, {}, kRobot), 0.3, 0.2));
  EXPECT_TRUE(area_of(table, pose(0, 0, 0.3), kRobot).empty());
}

// ---- Random solids against rays and points in space ----

/// Star-shaped about its centre with radii at random: closed, anything but convex.
Mesh random_rock(std::mt19937& random) {
  constexpr std::uint32_t kRound = 10;
  constexpr std::uint32_t kUp = 6;
  std::uniform_real_distribution<> radius_m(0.25, 0.8);
  Mesh rock{{}, {{0, 0, -radius_m(random)}, {0, 0, radius_m(random)}}};
  for (std::uint32_t k = 1; k < kUp; ++k)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      const double up_rad = kPi * k / kUp - kPi / 2;
      const double round_rad = 2 * kPi * i / kRound;
      const double r = radius_m(random);
      rock.vertices.push_back({r * std::cos(up_rad) * std::cos(round_rad),
                               r * std::cos(up_rad) * std::sin(round_rad), r * std::sin(up_rad)});
    }
  const auto at = [&](std::uint32_t k, std::uint32_t i) {
    return 2 + (k - 1) * kRound + i % kRound;
  };
  for (std::uint32_t i = 0; i < kRound; ++i) {
    rock.triangles.push_back({0, at(1, i + 1), at(1, i)});
    rock.triangles.push_back({1, at(kUp - 1, i), at(kUp - 1, i + 1)});
    for (std::uint32_t k = 1; k + 1 < kUp; ++k) {
      rock.triangles.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
      rock.triangles.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
    }
  }
  return rock;
}

/// By the angle under which the skin is seen (Van Oosterom and Strackee): 4 pi inside, 0 outside.
bool in_solid(const Mesh& mesh, const Vector3& from) {
  double seen = 0;
  for (const MeshTriangle& t : mesh.triangles) {
    std::array<Vector3, 3> v;
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& p = mesh.vertices[t[i]];
      v[i] = {p.x - from.x, p.y - from.y, p.z - from.z};
      n[i] = std::sqrt(v[i].x * v[i].x + v[i].y * v[i].y + v[i].z * v[i].z);
    }
    const auto d = [&](int i, int k) {
      return v[i].x * v[k].x + v[i].y * v[k].y + v[i].z * v[k].z;
    };
    const double volume = v[0].x * (v[1].y * v[2].z - v[1].z * v[2].y) -
                          v[0].y * (v[1].x * v[2].z - v[1].z * v[2].x) +
                          v[0].z * (v[1].x * v[2].y - v[1].y * v[2].x);
    seen += 2 * std::atan2(volume,
                           n[0] * n[1] * n[2] + d(0, 1) * n[2] + d(1, 2) * n[0] + d(2, 0) * n[1]);
  }
  return std::abs(seen) > 2 * kPi;
}

TEST(MeshAreas, OfRandomRocksCoverWhatIsSolidBetweenTheHeightsAndNoMore) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> at_m(-0.9, 0.9);
  int solid = 0;
  int free = 0;
  for (int i = 0; i < 40; ++i) {
    const Mesh rock = random_rock(random);
    const double low_m = 0.5 * at_m(random) - 0.2;
    const Heights heights{low_m, low_m + 0.3};
    const Area area = area_of(rock, {}, heights);
    for (int k = 0; k < 60; ++k) {
      const double x_m = at_m(random);
      const double y_m = at_m(random);
      bool any = false;
      for (int h = 0; h <= 60 && !any; ++h)
        any = in_solid(rock, {x_m, y_m, heights.low_m + 0.3 * (h + 0.01) / 60.02});
      if (any) {
        EXPECT_TRUE(covers(area, x_m, y_m)) << "rock " << i << " at " << x_m << ' ' << y_m;
        ++solid;
      } else if (covers(area, x_m, y_m)) {
        // Only so near to its edge that heights 5 mm apart do not show it.
        bool near = false;
        for (int turn = 0; turn < 16 && !near; ++turn)
          for (int h = 0; h <= 60 && !near; ++h)
            near = in_solid(
                rock, {x_m + 0.02 * std::cos(turn * kPi / 8), y_m + 0.02 * std::sin(turn * kPi / 8),
                       heights.low_m + 0.3 * (h + 0.01) / 60.02});
        EXPECT_TRUE(near) << "rock " << i << " at " << x_m << ' ' << y_m;
      } else {
        ++free;
      }
    }
  }
  EXPECT_GT(solid, 500);
  EXPECT_GT(free, 500);
}

}  // namespace
}  // namespace drover::scene
