// The simulated robot's mechanics: wheel torques in; wheel motion, pose and contacts out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/measurement.h"
#include "sim/plant/solid.h"

namespace drover::sim {

/// Of base_link in the world (x east, y north, z up, yaw counter-clockwise from east; REP 103).
struct BasePose {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double roll_rad = 0;
  double pitch_rad = 0;  ///< positive: nose down
  double yaw_rad = 0;    ///< [-pi, pi)
};

/// Of base_link, along its own axes.
struct BaseVelocity {
  double vx_mps = 0;
  double vy_mps = 0;
  double vz_mps = 0;
  double wx_radps = 0;
  double wy_radps = 0;
  double wz_radps = 0;
};

struct WheelState {
  double position_rad = 0;  ///< unbounded
  double velocity_radps = 0;
};

/// Deterministic: the same calls give the same bits. No clock, no threads.
class Plant {
 public:
  /// Loads an MJCF world. Throws std::runtime_error with the file and MuJoCo's message.
  explicit Plant(const std::string& world_file);
  ~Plant();
  Plant(Plant&&) noexcept;
  Plant& operator=(Plant&&) noexcept;

  double timestep_s() const;
  double time_s() const;

  /// Index of a joint for the calls below, in the world's order of motors.
  /// Throws std::runtime_error naming the joints that there are.
  std::size_t joint(std::string_view name) const;
  const std::vector<std::string>& joints() const;
  /// False: a joint of an arm, which has no tyre.
  bool is_wheel(std::size_t joint) const;

  /// Puts the robot down at rest, level with the ground under its wheels; wheel angles become 0.
  void place(double x_m, double y_m, double yaw_rad);
  /// Torque at a joint until it is set again; positive drives a wheel ahead.
  void set_torque(std::size_t joint, double torque_Nm);
  /// What holds a joint against turning, up to this torque, until it is set again: a brake.
  void set_holding_torque(std::size_t joint, double torque_Nm);
  /// Advances by one timestep.
  void step();
  /// Adds to the base's velocity, along its own axes: a shove.
  void kick(double vx_mps, double vy_mps);
  /// A force on the base, along its own axes, until it is set again.
  void push(double ahead_N, double left_N);
  /// A force on the arm's tip, in the world's axes, until it is set again. False: the world has no
  /// site "tip".
  struct Vector {
    double x = 0;
    double y = 0;
    double z = 0;
  };
  bool push_tip(const Vector& force_N);
  /// Where it is in the world.
  std::optional<Vector> tip_m() const;
  struct CarrySpeed {
    double vx_mps = 0;
    double vy_mps = 0;
    double wz_radps = 0;
  };
  /// As long as a speed is set the base is moved by somebody else, along the ground and along its
  /// own axes, and its wheels do not turn; set down it stands still.
  void carry(const std::optional<CarrySpeed>& speed);
  struct Shove {
    double ahead_m = 0;
    double left_m = 0;
    double turn_rad = 0;
    double lasts_s = 0;
  };
  /// A force displaces the base along its own axes, beside how it moves just now: wheels stand or
  /// roll on. It begins and ends gently; along an axis without displacement nothing pulls.
  void shove(const Shove& shove);

  /// The ground gives way under a wheel: it makes this share less of the way that it rolls, until
  /// it is set again.
  void set_slip(std::size_t joint, double share);
  /// The wheel is on the left side.
  bool is_left(std::size_t joint) const;
  /// The ground slides under all wheels by this share of their speed, in a direction of the world
  /// (counter-clockwise from east), until it is set again.
  void set_sideslip(double share, double direction_rad);
  /// Tilts what is a side slope of the world (bodies `side_slope...`), its north side up; the robot
  /// should not be on it. False: the world has none.
  bool set_side_slope(double tilt_rad);

  WheelState wheel(std::size_t joint) const;
  BasePose pose() const;
  BaseVelocity velocity() const;
  /// Velocity of a point that is fixed to the base (given in base_link), in the world's axes.
  Vector point_m(const Vector& in_base_m) const;
  Vector point_velocity_mps(const Vector& in_base_m) const;
  /// Of base_link in the world.
  Quaternion orientation() const;
  /// The same direction, seen along base_link's axes.
  Vector in_base_axes(const Vector& in_world) const;

  /// The bumper's strip touches something.
  bool bumper_touched() const;
  /// Along base_link's x from the bumper's face to the nearest obstacle in a corridor this wide;
  /// infinity when there is none.
  double free_distance_m(double width_m) const;

  /// From a point of the robot along a direction (both given in base_link) to what is there first,
  /// the robot itself left out; nothing within `reach_m`: there is none.
  std::optional<double> ray_m(const Vector& from_m, const Vector& along, double reach_m) const;

  /// Moves one of the world's movable obstacles, centred at x, y. False: no such obstacle.
  bool set_obstacle(std::string_view name, double x_m, double y_m);
  bool remove_obstacle(std::string_view name);

  /// How many solids the world can hold (worlds/objects.xml); 0: none.
  std::size_t object_slots() const;
  /// Puts it there in place of what had its name. Returns what is wrong, empty when nothing is.
  std::string put_object(std::string_view name, const Solid& solid);
  /// From now on it goes there on a straight line. False: there is no such thing.
  bool move_object(std::string_view name, double x_m, double y_m, double speed_mps);
  bool remove_object(std::string_view name);
  /// The height of the ground, for what is to stand on it.
  double ground_m(double x_m, double y_m) const;
  struct PlacedObject {
    std::string name;
    Solid solid;
    bool moves = false;
  };
  std::vector<PlacedObject> objects() const;

  struct Touch {
    std::string_view
        what;  ///< a solid's name, or that of a thing of the world; lives with the plant
    double depth_m = 0;
  };
  /// What the robot's body touched in the last step, each thing once. Not the ground under it.
  const std::vector<Touch>& touches() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drover::sim
