// What stood in the robot's way at each instant, and what the robot touched, as lines of a log:
//   (12.345000000) watching 36                                     so many can be put there
//   (12.345000000) put NAME box X Y Z YAW LENGTH WIDTH HEIGHT      Z: of the middle of its height
//   (12.345000000) put NAME cylinder|cone X Y Z YAW RADIUS HEIGHT
//   (12.345000000) put NAME sphere X Y Z YAW RADIUS
//   (12.345000000) put NAME prism X Y Z YAW HEIGHT X1 Y1 X2 Y2 ...
//   (12.345000000) at NAME X Y                                     it went there
//   (12.345000000) gone NAME
//   (12.345000000) touch NAME X Y YAW VX VY WZ DEPTH               the robot, as it began
//   (12.345000000) leave NAME DEPTH M_PER_S RAD_PER_S              the most of each during it
#pragma once

#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/plant/plant.h"

namespace drover::sim {

/// In a world without such things it says nothing.
class ObjectRecord {
 public:
  /// Each tick, with the pose that the tick's truth has.
  void note_objects(Time now, const Plant& plant);
  /// After each mechanical step.
  void note_touches(Time now, const Plant& plant);
  /// The lines since the last call.
  std::string take();

 private:
  struct Touching {
    std::string what;
    double depth_m = 0;
    double fastest_mps = 0;
    double fastest_radps = 0;
    bool still = false;
  };
  void begin(Time now, const std::string& words);

  bool watching_ = false;
  std::vector<Plant::PlacedObject> known_;
  std::vector<Touching> touching_;
  std::string lines_;
};

}  // namespace drover::sim
