// What Plant hides: the model, its state, and the numbers of the things in it.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/plant/objects.h"
#include "sim/plant/plant.h"
#include "sim/plant/tyre.h"

namespace drover::sim {

inline constexpr std::size_t kMaxBoxes = 64;

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

// What a wheel needs for its tyre's force.
struct Wheel {
  int body = 0;
  int contact_geom = 0;  ///< -1: no wheel, but a joint of an arm
  Tyre tyre;
  double roller_rad = 0;  ///< where its rollers' axes point, left of ahead; 0: it has none
  double slip = 0;        ///< share of the rolled way that the ground gives way
};

// A shove under way: where it began, and what it works against.
struct ShoveState {
  Plant::Shove shove;
  double begin_s = 0;
  std::array<double, 2> ahead{};  // in the world, as the other axes
  std::array<double, 3> start{};  // x, y, yaw
  std::array<double, 3> speed{};  // along ahead, along left, turning
  double mass_kg = 0;
  double inertia_kgm2 = 0;
};

// Dry friction of a joint and how hard the solver insists on it.
struct Friction {
  double torque_Nm = 0;
  std::array<mjtNum, mjNREF> reference{};
  std::array<mjtNum, mjNIMP> impedance{};
};

// How the robot stands on the ground at some place.
struct Footing {
  double z_m = 0;
  double pitch_rad = 0;
  double roll_rad = 0;
};

struct Plant::Impl {
  std::unique_ptr<mjModel, ModelDeleter> model;
  std::unique_ptr<mjData, DataDeleter> data;
  int base = 0;         // body
  int base_qpos = 0;    // position, quaternion
  int base_qvel = 0;    // linear in the world's axes, angular in the body's
  int bumper = -1;      // geom; the world may have none
  double front_m = 0;   // the bumper's face in base_link
  double radius_m = 0;  // of the wheels
  std::vector<std::string> joints;
  std::vector<int> joint_ids;
  std::vector<Wheel> wheels;            // by joint
  std::vector<Friction> free_friction;  // by joint: of the model, when nothing holds it
  std::vector<int> boxes;               // geoms that a scanner sees
  std::vector<int> feet;                // geoms of the robot that touch the ground: wheels, castors
  std::vector<std::array<double, 2>> feet_m;  // the same in base_link
  std::array<mjtNum, 3> push_N{};             // along the base's axes
  int tip = -1;                               // site; the world may have none
  std::array<mjtNum, 3> tip_push_N{};         // along the world's axes
  std::optional<CarrySpeed> carried;
  std::optional<ShoveState> shoved;
  std::array<mjtNum, 3> slides{};  // of a wheel's speed, in the world
  std::optional<Objects> objects;  // set as soon as there is a model
  std::vector<int> body_geoms;     // of the robot, that obstacles touch
  std::vector<Touch> touches;      // in the last step

  Friction friction(std::size_t joint) const;
  void set_friction(std::size_t joint, const Friction& friction);
  const mjtNum* rotation() const { return data->xmat + 9 * base; }
  int mocap(std::string_view name) const;
  void pull_tyre(Wheel& wheel);
  void push();
  void push_tip();
  void shove();
  void carry();
  void feel();
  bool is_body(int geom) const;
  Footing footing(double x_m, double y_m, double yaw_rad) const;
  void set_pose(double x_m, double y_m, double yaw_rad);
  double ground_m(double x_m, double y_m) const;
  bool set_mocap(std::string_view name, double x_m, double y_m, double z_m);
};

}  // namespace drover::sim
