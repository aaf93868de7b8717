// The world's reserved bodies, each of which becomes a solid at run time: see worlds/objects.xml.
#pragma once

#include <mujoco/mujoco.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/plant/solid.h"

namespace drover::sim {

/// Rewrites sizes in the model: MuJoCo reads them anew in each step, and so does its broad phase
/// once the bounding radius is right.
class Objects {
 public:
  /// Finds the bodies. None: this world has no such things.
  explicit Objects(const mjModel& model);

  std::size_t slots() const { return slots_.size(); }
  /// Puts it there in place of what had its name. Returns what is wrong, empty when nothing is.
  std::string put(mjModel& model, mjData& data, std::string_view name, const Solid& solid);
  /// It goes there on a straight line from now on. False: there is no such thing.
  bool move(std::string_view name, double x_m, double y_m, double speed_mps);
  bool remove(mjData& data, std::string_view name);
  /// Those that move go on by so much time.
  void advance(mjData& data, double dt_s);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// The name of what this geom is part of; empty: of nothing here.
  std::string_view name_of(int geom) const;
  bool owns(int geom) const { return slot_of(geom) != nullptr; }

  struct Placed {
    std::string name;
    Solid solid;
    bool moves = false;
  };
  /// In the order of the slots.
  std::vector<Placed> placed() const;

 private:
  struct Journey {
    double x_m = 0;
    double y_m = 0;
    double speed_mps = 0;
  };
  struct Slot {
    int geom = -1;
    int mocap = -1;
    int mesh = -1;     // -1: a box, a cylinder or a sphere
    std::string name;  // empty: it is parked
    Solid solid;
    std::optional<Journey> journey;
  };
  const Slot* find(std::string_view name) const;
  Slot* find(std::string_view name) {
    return const_cast<Slot*>(static_cast<const Objects*>(this)->find(name));
  }
  const Slot* slot_of(int geom) const;
  Slot* free_slot(bool convex);
  static void shape(mjModel& model, const Slot& slot);
  static void shape_mesh(mjModel& model, const Slot& slot);
  static void show(mjData& data, const Slot& slot);
  static void park(mjData& data, Slot& slot);

  std::vector<Slot> slots_;
};

}  // namespace drover::sim
