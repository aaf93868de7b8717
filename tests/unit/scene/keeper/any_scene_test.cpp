// Whatever comes, from whatever place: nothing throws, hangs, or reads as free without a number.
#include <random>

#include "tests/unit/scene/keeper/fixture.h"

namespace drover::scene {
namespace {

/// Numbers, mostly of a yard, at times of anything.
class Any {
 public:
  explicit Any(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  double yard_m() { return std::uniform_real_distribution<>(-8, 8)(random_); }
  double number() {
    static const std::vector<double> kOdd{0,    -0.0, NAN,   kEndless, -kEndless, 1e-300, 1e300,
                                          1e-3, 1e6,  -1e12, kPi,      -kPi,      0.1,    1e18};
    return below(8) == 0 ? kOdd[below(kOdd.size())] : yard_m();
  }
  drover::scene::Pose pose() {
    return {{number(), number(), below(3) == 0 ? number() : 0.3},
            below(4) == 0 ? Quaternion{number(), number(), number(), number()} : Quaternion{}};
  }
  std::string frame() {
    static const std::vector<std::string> kFrames{"map", "1", "base_link", "mast", "0", ""};
    return kFrames[below(3) == 0 ? below(kFrames.size()) : 0];
  }
  SolidPrimitive primitive() {
    SolidPrimitive shape;
    shape.type = static_cast<std::uint8_t>(below(6));
    for (std::size_t i = below(4); i > 0; --i) shape.dimensions.push_back(std::abs(number()) / 8);
    return shape;
  }
  Mesh mesh() {
    Mesh shape;
    for (std::size_t i = below(8); i > 0; --i)
      shape.vertices.push_back({number(), number(), number()});
    for (std::size_t i = below(8); i > 0; --i)
      shape.triangles.push_back({static_cast<std::uint32_t>(below(9)),
                                 static_cast<std::uint32_t>(below(9)),
                                 static_cast<std::uint32_t>(below(9))});
    return shape;
  }
  CollisionObject object() {
    CollisionObject message;
    message.id = std::to_string(below(12));
    message.header.frame_id = frame();
    message.header.stamp.sec = static_cast<std::uint32_t>(below(4) == 0 ? below(120) : 0);
    message.operation = static_cast<std::uint8_t>(below(5));
    for (std::size_t i = below(3); i > 0; --i) message.primitives.push_back(primitive());
    if (below(4) == 0) message.meshes.push_back(mesh());
    if (below(6) == 0) message.planes.push_back({{number(), number(), number(), number()}});
    for (std::size_t i = below(3); i > 0; --i) message.primitive_poses.push_back(pose());
    if (below(4) == 0) message.mesh_poses.push_back(pose());
    if (below(6) == 0) message.plane_poses.push_back(pose());
    return message;
  }
  Constraints constraints() {
    Constraints set;
    set.name = std::to_string(below(3));
    if (below(2) == 0) set.joint_constraints.push_back({"base/x", number(), 9, number(), number()});
    if (below(3) == 0) {
      PositionConstraint inside;
      inside.header.frame_id = frame();
      inside.link_name = "base_link";
      inside.constraint_region.primitives = {primitive()};
      inside.constraint_region.primitive_poses = {pose()};
      set.position_constraints.push_back(inside);
    }
    if (below(3) == 0) {
      VisibilityConstraint sight;
      sight.target_radius = number();
      sight.target_pose = {{0, {}, frame()}, pose()};
      sight.sensor_pose = {{0, {}, frame()}, pose()};
      sight.cone_sides = static_cast<std::int32_t>(below(12)) - 2;
      set.visibility_constraints.push_back(sight);
    }
    return set;
  }
  Path path() {
    Path made;
    made.number = 3;
    PathPoint at{yard_m(), yard_m()};
    for (std::size_t i = below(40); i > 0; --i) {
      made.points.push_back(at);
      const bool odd = below(60) == 0;
      at = {odd ? number() : at.x_m + 0.1 * yard_m(), odd ? number() : at.y_m + 0.1 * yard_m()};
    }
    return made;
  }
  void move(Viewpoint& from) {
    from.t += std::chrono::milliseconds(below(300));
    from.pose.x_m = number();
    from.pose.y_m = number();
    from.pose.yaw_rad = number();
    from.pose.position_sigma_m = below(3) == 0 ? number() : 0.02;
    from.pose.yaw_sigma_rad = below(3) == 0 ? number() : 0.02;
    from.commanded = {0.1 * number(), 0.1 * number()};
    from.asked = {0.1 * number(), 0.1 * number()};
    from.roll_rad = from.pitch_rad = below(3) == 0 ? number() : 0;
    from.way = {below(4), below(2) == 0, static_cast<std::uint32_t>(below(42)),
                static_cast<std::uint32_t>(below(42)), number()};
    from.joint_rad.resize(below(5));
    for (double& joint : from.joint_rad) joint = number();
    if (below(20) == 0) ++from.place;
    if (below(30) == 0) from.origin.latitude_deg = below(2) == 0 ? number() : 48;
  }

 private:
  std::mt19937 random_;
};

bool is_sound(double way) {
  return way >= 0;  // and no NaN
}

void expect_sound(const Clearance& found, const Viewpoint& from, bool empty) {
  EXPECT_TRUE(is_sound(found.along_m) && is_sound(found.ahead_m) && is_sound(found.back_m) &&
              is_sound(found.left_rad) && is_sound(found.right_rad));
  const bool is_placed = std::isfinite(from.pose.x_m + from.pose.y_m) &&
                         std::isfinite(from.pose.position_sigma_m) &&
                         from.pose.position_sigma_m >= 0;
  if (is_placed || empty) return;
  EXPECT_FALSE(found.unknown.empty());
  EXPECT_EQ(found.along_m + found.ahead_m + found.back_m + found.left_rad + found.right_rad, 0);
}

class AnyScene : public AKeeper, public testing::WithParamInterface<bool> {
 protected:
  static KeeperSettings settings() {
    KeeperSettings made = keeper_settings();
    made.robot.links.push_back({"mast", {{0.3, 0, 1}, {}}, {}});
    if (GetParam()) made.heights = {-kEndless, kEndless};
    return made;
  }
  AnyScene() : AKeeper(settings()) {}
};

TEST_P(AnyScene, IsJudgedFromAnyPlaceAndNeverFreeByAccident) {
  Any any(GetParam() ? 11 : 10);
  int looked = 0;
  int free = 0;
  for (int round = 0; round < 4000; ++round) {
    if (any.below(60) == 0) keeper.clear();
    if (any.below(50) == 0)
      keeper.set_zones({zone("a", Zone::Kind::keep_out, any.yard_m(), any.yard_m(), 1),
                        zone("b", any.below(2) == 0 ? Zone::Kind::keep_in : Zone::Kind::keep_out,
                             any.yard_m(), any.yard_m(), 9)},
                       "");
    if (any.below(50) == 0) keeper.set_zones({}, "");
    apply(any.object());
    if (any.below(20) == 0) apply(any.constraints());
    any.move(from);
    const Path path = any.path();
    const bool empty = keeper.world().objects().empty() && keeper.world().constraints().empty() &&
                       keeper.zones().empty();
    const Clearance found = look(&path);
    expect_sound(found, from, empty);
    ++looked;
    free += found.unknown.empty() && found.ahead_m > 0;
    if (round % 5 == 0 && !path.points.empty())
      check(path, static_cast<std::uint32_t>(any.below(path.points.size())));
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(free, looked / 50) << "most scenes cannot be judged: it tests nothing";
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutHeights, AnyScene, testing::Bool());

}  // namespace
}  // namespace drover::scene
