// What a person sees while a scenario runs: a picture redrawn in place, plain lines, or nothing.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/scenario/mission.h"
#include "sim/scenario/picture.h"
#include "sim/scenario/robot_report.h"
#include "sim/scenario/status_client.h"

namespace drover::sim {

enum class ViewKind { none, lines, terminal };

/// "7.3 m left, about 15 s"; without a speed worth the name no time; nothing is "-".
std::string way_left(double distance_m, double speed_mps);

/// "rad/s  left 1.20  right -": what is not heard of is no number.
std::string wheel_words(const nlohmann::json& axes);
/// "error 0.014 m (one sigma)", or "error -".
std::string error_words(double sigma_m);

/// "ahead 2.31 m, back 3.00 m, left 180 deg, right 40 deg" of the status' clearance; why nothing is
/// known, or nothing where it has none.
std::string free_room(const nlohmann::json& status);
/// "box1 is in the way, 2.31 m ahead", or nothing.
std::string first_in_the_way(const nlohmann::json& status);

/// "battery 84.0 % 26.4 V -1.2 A; IMU fresh, roll 0.1 pitch 0.0 deg" of what the robot has.
std::string sensor_words(const nlohmann::json& status);

class View {
 public:
  View(ViewKind kind, bool coloured, const Mission& mission, const std::string& daemon_socket);

  /// Draws when it is time; returns when it will be time again (Time::max(): never).
  Time draw(Time now, const RobotReport& report);
  /// Of a question to droverd that is on its way; -1: none.
  int descriptor() const { return status_.descriptor(); }
  void on_readable() { status_.on_readable(); }

  /// The map of the whole drive, where no picture was drawn. Nothing is drawn from now on.
  void close();

  /// A command to the simulator: obstacles appear on the map.
  void on_sim_command(const std::string& command);
  /// It is there, elsewhere or gone.
  void on_object(const ObjectSpec& object);
  void on_zone(const ZoneSpec& zone);
  /// What the player does and hears.
  void on_event(const std::string& text);

 private:
  void note_place(const RobotReport& report);
  std::vector<std::string> map() const;
  std::string line(const RobotReport& report) const;
  std::string picture(const RobotReport& report) const;
  std::string place(const RobotReport& report) const;
  std::string wheels() const;
  std::string left(const RobotReport& report) const;

  ViewKind kind_;
  bool coloured_;
  const Mission& mission_;
  StatusClient status_;
  Surroundings around_;
  std::optional<TrackPose> robot_;
  std::string last_event_;
  Time begin_ = kNever;
  Time next_ = kNever;
  std::size_t lines_ = 0;  ///< drawn so far
  double elapsed_s_ = 0;
};

}  // namespace drover::sim
