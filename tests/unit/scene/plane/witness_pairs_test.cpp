// Random and grid-aligned pairs of a shape and a robot against the second opinion. DROVER_LONG=1:
// a million of them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <sstream>

#include "drover/angle.h"
#include "scene/plane/areas.h"
#include "scene/plane/overlap.h"
#include "tests/unit/scene/plane/witness.h"

namespace drover::scene {
namespace {

using P = SolidPrimitive;
using witness::Verdict;

constexpr double kFine_m = 1e-3;  // what is asked of the product
// Of a prism with 64 sides around a tilted cylinder: 1 / cos(pi / 64) - 1.
constexpr double kOutside = 0.00121;

int pairs() {
  const char* asked = std::getenv("DROVER_LONG");
  return asked && *asked ? 1'000'000 : 20'000;
}

struct Pair {
  witness::Body body;
  std::vector<Point2> footprint;
  double margin_m = 0;
  Pose2 pose;
  Heights heights;
};

/// Numbers anywhere, or on a grid on which things touch, align and have equal centres.
class Dice {
 public:
  Dice(unsigned seed, bool on_grid) : random_(seed), on_grid_(on_grid) {}

  double number(double low, double high, double grid) {
    const double any = low + (high - low) * std::uniform_real_distribution<>()(random_);
    return on_grid_ ? std::round(any / grid) * grid : any;
  }
  int one_of(int count) { return std::uniform_int_distribution<>(0, count - 1)(random_); }

  Quaternion upright() {
    const double half_rad = 0.5 * number(-kPi, kPi, kPi / 4);
    if (one_of(4) > 0) return {std::cos(half_rad), 0, 0, std::sin(half_rad)};
    return {0, std::cos(half_rad), std::sin(half_rad), 0};  // upside down
  }
  Quaternion any_turn() {
    std::normal_distribution<> gauss;
    Quaternion q{gauss(random_), gauss(random_), gauss(random_), gauss(random_)};
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / length, q.x / length, q.y / length, q.z / length};
  }

 private:
  std::mt19937 random_;
  bool on_grid_;
};

Pair roll(Dice& dice, bool upright) {
  Pair pair;
  auto& [shape, pose] = pair.body;
  shape.type = static_cast<std::uint8_t>(1 + dice.one_of(4));
  const auto size_m = [&] { return dice.number(0.02, 1.5, 0.05) + 0.05; };
  shape.dimensions = {size_m()};
  if (shape.type != P::SPHERE) shape.dimensions.push_back(size_m());
  if (shape.type == P::BOX) shape.dimensions.push_back(size_m());
  const Point2 far = dice.one_of(8) == 0 ? Point2{322'100, -4.5e6} : Point2{};
  pair.pose = {far.x_m + dice.number(-1, 1, 0.05), far.y_m + dice.number(-1, 1, 0.05),
               dice.number(-kPi, kPi, kPi / 4)};
  pose.position_m = {far.x_m + dice.number(-1.8, 1.8, 0.05), far.y_m + dice.number(-1.8, 1.8, 0.05),
                     dice.number(-0.4, 1.4, 0.05)};
  pose.orientation = upright ? dice.upright() : dice.any_turn();
  pair.footprint = {{-0.35, -0.35}, {0.55, -0.35}, {0.55, 0.35}, {-0.35, 0.35}};
  if (dice.one_of(2) == 0)
    pair.footprint = {{-0.3, -0.2}, {0.2, -0.3}, {0.5, 0}, {0.2, 0.3}, {-0.3, 0.2}};
  pair.margin_m = dice.number(0.01, 0.1, 0.05) + 2 * kFine_m;
  pair.heights = {dice.number(0.02, 0.2, 0.05), dice.number(0.4, 1.0, 0.05)};
  return pair;
}

/// The robot for the second opinion, larger by `more_m` on all sides.
witness::Robot robot(const Pair& pair, double more_m) {
  witness::Robot robot;
  const double c = std::cos(pair.pose.yaw_rad);
  const double s = std::sin(pair.pose.yaw_rad);
  for (const Point2 p : pair.footprint)
    robot.footprint.corners.push_back(
        {pair.pose.x_m + c * p.x_m - s * p.y_m, pair.pose.y_m + s * p.x_m + c * p.y_m});
  robot.margin = pair.margin_m + more_m;
  robot.low = pair.heights.low_m - more_m;
  robot.high = pair.heights.high_m + more_m;
  return robot;
}

/// Moves the body along the line from the robot to where the judge sees them touch, give or take
/// three millimetres: there the answers differ that are nearly right.
void bring_near(Pair& pair, Dice& dice) {
  auto& at = pair.body.pose.position_m;
  const Point2 from{pair.pose.x_m, pair.pose.y_m};
  const Point2 away = Point2{at.x, at.y} - from;
  const auto put = [&](double part) {
    at.x = from.x_m + part * away.x_m;
    at.y = from.y_m + part * away.y_m;
  };
  double inside = 0;
  double outside = 4 / std::max(length_m(away), 0.1);
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (inside + outside);
    put(middle);
    (judge(pair.body, robot(pair, 0)) == Verdict::apart ? outside : inside) = middle;
  }
  put(inside + dice.number(-3, 3, 1) * kFine_m / std::max(length_m(away), 0.1));
}

std::string told(const Pair& pair) {
  const auto& [shape, pose] = pair.body;
  std::ostringstream out;
  out.precision(17);
  out << "type " << int(shape.type) << " size";
  for (const double d : shape.dimensions) out << ' ' << d;
  out << " at " << pose.position_m.x << ' ' << pose.position_m.y << ' ' << pose.position_m.z
      << " turn " << pose.orientation.w << ' ' << pose.orientation.x << ' ' << pose.orientation.y
      << ' ' << pose.orientation.z << " robot " << pair.pose.x_m << ' ' << pair.pose.y_m << ' '
      << pair.pose.yaw_rad << " margin " << pair.margin_m << " heights " << pair.heights.low_m
      << ' ' << pair.heights.high_m;
  return out.str();
}

struct Count {
  int hits = 0;
  int free = 0;
  int doubtful = 0;  ///< hits of which it is not known whether they are
  int doubtfully_free = 0;
  int wide = 0;  ///< hits that are apart by more than kFine_m
};

/// `slack` of the shape's largest size is what a hit may be early beside kFine_m.
void compare(const Pair& pair, double slack, Count& count) {
  const bool hit = overlaps(placed(piece_of(pair.footprint, pair.margin_m), pair.pose),
                            area_of(pair.body.shape, pair.body.pose, pair.heights));
  ++(hit ? count.hits : count.free);
  Verdict verdict = judge(pair.body, robot(pair, hit ? kFine_m : -kFine_m));
  // That something is free is not left in doubt so soon.
  if (!hit && verdict == Verdict::unknown)
    verdict = judge(pair.body, robot(pair, -kFine_m), 20'000);
  if (verdict == Verdict::unknown) ++(hit ? count.doubtful : count.doubtfully_free);
  if (!hit) {
    EXPECT_NE(verdict, Verdict::overlap) << "free, and it is not: " << told(pair);
  } else if (verdict == Verdict::apart) {
    ++count.wide;
    const auto& size = pair.body.shape.dimensions;
    const double more_m = kFine_m + slack * *std::max_element(size.begin(), size.end());
    EXPECT_NE(judge(pair.body, robot(pair, more_m)), Verdict::apart) << told(pair);
  }
}

enum class Place { anywhere, on_a_grid, nearly_touching };

Count compare_all(unsigned seed, bool upright, Place place) {
  Dice dice(seed, place == Place::on_a_grid);
  Count count;
  for (int i = 0; i < pairs() / 5 && !testing::Test::HasFailure(); ++i) {
    Pair pair = roll(dice, upright);
    if (place == Place::nearly_touching) bring_near(pair, dice);
    compare(pair, upright ? 0 : kOutside, count);
  }
  // A comparison in which one answer is rare proves nothing.
  EXPECT_GT(std::min(count.hits, count.free), pairs() / 5 / 5);
  const double doubt = place == Place::nearly_touching ? 0.08 : 0.004;
  EXPECT_LE(count.doubtfully_free, pairs() / 5 / 4000);
  EXPECT_LT(count.doubtful, doubt * pairs() / 5);
  std::cout << count.hits << " hits, " << count.free << " free, " << count.doubtful << " and "
            << count.doubtfully_free << " doubtful, " << count.wide
            << " hits by more than 1 mm too early\n";
  return count;
}

TEST(WitnessedPairs, UprightShapesAnywhereAreExactToAMillimetre) {
  EXPECT_EQ(compare_all(1, true, Place::anywhere).wide, 0);
}
TEST(WitnessedPairs, UprightShapesOnAGridAreExactToAMillimetre) {
  EXPECT_EQ(compare_all(2, true, Place::on_a_grid).wide, 0);
}
TEST(WitnessedPairs, UprightShapesThatNearlyTouchAreExactToAMillimetre) {
  EXPECT_EQ(compare_all(3, true, Place::nearly_touching).wide, 0);
}
TEST(WitnessedPairs, TiltedShapesOnAGridAreNeverFreeAndHardlyWider) {
  const Count count = compare_all(4, false, Place::on_a_grid);
  EXPECT_LT(count.wide, count.hits / 100);
}
TEST(WitnessedPairs, TiltedShapesThatNearlyTouchAreNeverFreeAndHardlyWider) {
  const Count count = compare_all(5, false, Place::nearly_touching);
  EXPECT_LT(count.wide, count.hits / 10);
}

/// The judge itself, on pairs that anybody can judge.
TEST(Witness, TellsWhatEverybodySees) {
  witness::Robot square{{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, 0.1, 0, 1};
  const auto ball_at = [](double x, double y, double z) {
    return witness::Body{{P::SPHERE, {0.5}}, {{x, y, z}, {}}};
  };
  EXPECT_EQ(judge(ball_at(0, 0, 0.5), square), Verdict::overlap);
  EXPECT_EQ(judge(ball_at(1.59, 0, 0.5), square), Verdict::overlap);
  EXPECT_EQ(judge(ball_at(1.61, 0, 0.5), square), Verdict::apart);
  EXPECT_EQ(judge(ball_at(1.5, 1.5, 0.5), square), Verdict::apart);
  EXPECT_EQ(judge(ball_at(0, 0, -0.51), square), Verdict::apart);
  const witness::Body cone{{P::CONE, {1, 1}}, {{1.8, 0, 0.5}, {}}};
  EXPECT_EQ(judge(cone, square), Verdict::overlap);
  square.low = 0.35;  // the cone is 0.65 wide there
  EXPECT_EQ(judge(cone, square), Verdict::apart);
}

}  // namespace
}  // namespace drover::scene
