// An object of a scenario: what the robot is told of it, and what stands there.
//
//   {"object": {"id": "box1", "box": [0.4, 0.3, 1.2], "at": [3, 0.5], "yaw_deg": 20, "z_m": 0.6}}
//   {"object": {"id": "pole", "cylinder": [0.01, 1.5], "at": [3, 0.5], "told": false}}
//   {"object": {"id": "person", "to": [3, -4], "speed_mps": 1.2, "told_Hz": 10}}
//   {"object": {"id": "box1", "gone": true, "there": false}}
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/robot/json_reader.h"
#include "sim/scenario/track.h"

namespace drover::sim {

struct ObjectSpec {
  enum class Does { appears, moves, goes };
  Does does = Does::appears;
  std::string id;
  std::string shape;            ///< box, cylinder, sphere, cone
  std::vector<double> sizes_m;  ///< box: length, width, height; cylinder, cone: radius, height
  double x_m = 0;               ///< in the simulator's frame; of a journey its end
  double y_m = 0;
  double yaw_deg = 0;
  std::optional<double> z_m;  ///< of its middle; none: it stands on the ground
  double speed_mps = 1;       ///< of a journey
  double told_Hz = 10;        ///< how often the robot is told of a journey
  bool told = true;           ///< the robot is told
  bool there = true;          ///< it stands there, and can be touched
};

/// `raw` is what the reader reads. Throws std::runtime_error naming the key.
ObjectSpec read_object(JsonReader reader, const nlohmann::json& raw);

/// To the simulator: see object_command.h.
std::string obstacle_command(const ObjectSpec& spec);
/// Seen from above, in the simulator's frame.
std::vector<TrackPose> outline(const ObjectSpec& spec);

/// CollisionObject messages; `shift` is map_shift()'s.
nlohmann::ordered_json added_message(const ObjectSpec& spec, const TrackPose& shift);
nlohmann::ordered_json moved_message(const ObjectSpec& spec, const TrackPose& shift);
nlohmann::ordered_json removed_message(const std::string& id);

/// A message whose places in `map` are given in the simulator's frame: below a header that says so
/// every position is shifted.
nlohmann::ordered_json in_map(nlohmann::ordered_json message, const TrackPose& shift);
/// Every header gets this stamp.
void set_stamps(nlohmann::ordered_json& message, Duration since_epoch);

/// What is underway.
class Journeys {
 public:
  /// From where `object` is, as `journey` says. Ends another one of it.
  void begin(const ObjectSpec& object, const ObjectSpec& journey, Time now);
  void end(const std::string& id);
  struct Arrival {
    ObjectSpec object;  ///< where it is now
    bool told = true;
    bool arrived = false;
  };
  /// Of whom the robot is to be told now.
  std::vector<Arrival> due(Time now);
  Time next() const;

 private:
  struct Journey {
    ObjectSpec object;  // where it began
    ObjectSpec to;
    Time begin = kNever;
    Time next = kNever;
  };
  std::vector<Journey> journeys_;
};

}  // namespace drover::sim
