// What a person sees while a scenario runs: a picture redrawn in place, plain lines, or nothing.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/scenario/mission.h"
#include "sim/scenario/robot_report.h"
#include "sim/scenario/status_client.h"

namespace drover::sim {

enum class ViewKind { none, lines, terminal };

/// "7.3 m left, about 15 s"; without a speed worth the name no time; nothing is "-".
std::string way_left(double distance_m, double speed_mps);

/// "free ahead 2.31 m, back 3.00 m, left 180 deg, right 40 deg; box1 is in the way, ..." of the
/// status' clearance; why nothing is known, or nothing where it has none.
std::string free_way(const nlohmann::json& status);

class View {
 public:
  View(ViewKind kind, const Mission& mission, const std::string& daemon_socket);

  /// Draws when it is time; returns when it will be time again (Time::max(): never).
  Time draw(Time now, const RobotReport& report);
  /// Of a question to droverd that is on its way; -1: none.
  int descriptor() const { return status_.descriptor(); }
  void on_readable() { status_.on_readable(); }

  /// Draws nothing from now on: what stands there is to be read.
  void rest() { kind_ = ViewKind::none; }

  /// A command to the simulator: obstacles appear on the map.
  void on_sim_command(const std::string& command);
  /// Seen from above; an empty outline: it is gone.
  void on_object(const std::string& id, std::vector<TrackPose> outline);
  /// An empty polygon: it is deleted.
  void on_zone(const std::string& name, std::vector<TrackPose> polygon, bool keep_in);
  /// What the player does and hears.
  void on_event(const std::string& text);

 private:
  std::string line(const RobotReport& report) const;
  std::string picture(const RobotReport& report) const;
  std::string wheels() const;
  std::string sensors() const;
  std::string left(const RobotReport& report) const;

  ViewKind kind_;
  const Mission& mission_;
  StatusClient status_;
  struct ShownZone {
    std::vector<TrackPose> polygon;
    bool keep_in = false;
  };
  std::map<std::string, TrackPose> obstacles_;
  std::map<std::string, std::vector<TrackPose>> objects_;
  std::map<std::string, ShownZone> zones_;
  std::string last_event_;
  Time begin_ = kNever;
  Time next_ = kNever;
  std::size_t lines_ = 0;  ///< drawn so far
  double elapsed_s_ = 0;
};

}  // namespace drover::sim
