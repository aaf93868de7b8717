// Judges what tests/mission/scenes played: each thing that appeared, by how far ahead it was then.
#include "mission/scene_series.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mission/conduct.h"
#include "mission/robot.h"
#include "mission/scene_drive.h"
#include "mission/scene_way.h"

namespace drover::mission {
namespace {

using namespace std::chrono_literals;

constexpr double kStanding_mps = 0.01;
// scene.again_s, default, and what looking, answering and beginning to move take.
constexpr auto kAgain = 1500ms;

struct Drive {
  Time start = kNever;
  Time end = Time::max();
  std::size_t target = 0;
};

std::vector<Drive> drives_of(const Record& log) {
  std::vector<Drive> drives;
  for (const auto& line : log.mqtt) {
    if (line.topic != "mqtt_control") continue;
    const auto message = nlohmann::json::parse(line.payload, nullptr, false);
    if (!message.is_object() || message.value("cmd", "") != "start_task") continue;
    if (!drives.empty()) drives.back().end = line.time;
    drives.push_back({line.time, Time::max(), message.at("id").get<std::size_t>()});
  }
  return drives;
}

const char* word(Appeared::Where where) {
  switch (where) {
    case Appeared::Where::beside: return "beside";
    case Appeared::Where::grazing: return "grazing";
    case Appeared::Where::far: return "far";
    case Appeared::Where::between: return "between";
    case Appeared::Where::near: return "near";
    case Appeared::Where::at_rest: return "at rest";
  }
  return "";
}

/// Far enough to stop before it, nearer than a ramp to zero takes, or neither.
Appeared::Where judge_distance(double way_m, double v_mps) {
  const double brakes_m = braking_way_m(v_mps);
  if (way_m >= kChain_s * v_mps + brakes_m + kMargin_m + kBlur_m) return Appeared::Where::far;
  return way_m < brakes_m + kMargin_m ? Appeared::Where::near : Appeared::Where::between;
}

class Series {
 public:
  explicit Series(const Record& record)
      : log_(record),
        scene_(read_scene_log(record)),
        way_(record.track),
        drives_(drives_of(record)) {}

  SeriesReport judge_all() {
    report_.drives = drives_.size();
    for (const auto& answer : log_.feedback)
      if (answer.cmd == "start_task_success") ++report_.accepted;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i)
      if (scene_.objects[i].verb == "put") look_at(scene_.objects[i], i);
    judge_contacts();
    judge_touches();
    return std::move(report_);
  }

 private:
  const Drive* drive_at(Time time) const {
    const Drive* found = nullptr;
    for (const auto& drive : drives_)
      if (drive.start <= time) found = &drive;
    return found;
  }

  Time gone(std::size_t from, const std::string& name) const {
    for (std::size_t i = from; i < scene_.objects.size(); ++i)
      if (scene_.objects[i].verb == "gone" && scene_.objects[i].name == name)
        return scene_.objects[i].time;
    return log_.truth.back().time;
  }

  /// Where on its way the robot is, and how far beside it.
  void locate(const TruePose& pose, const Drive& drive, double& s_m, double& beside_m) const {
    // A drive begins at most as far before its target as two of them are long.
    const double target_m = target_at_m(drive.target);
    const double from_m = std::max(0.0, target_m - 2 * kDrive_m - 1);
    s_m = way_.nearest_m({pose.x_m, pose.y_m}, from_m, target_m - from_m + 0.5);
    const TruePose on = way_.pose(s_m);
    beside_m =
        -std::sin(on.yaw_rad) * (pose.x_m - on.x_m) + std::cos(on.yaw_rad) * (pose.y_m - on.y_m);
  }

  void look_at(const ObjectLine& put, std::size_t index) {
    Appeared one;
    one.name = put.name;
    one.kind = put.solid.kind;
    one.time = put.time;
    one.gone = gone(index, put.name);
    const Drive* const drive = drive_at(put.time);
    const auto thing = flat(put.solid);
    if (drive == nullptr || !thing) return;
    const TruePose& pose = scene_.pose_at(put.time);
    one.v_mps = pose.vx_mps;
    double s_m = 0;
    double beside_m = 0;
    locate(pose, *drive, s_m, beside_m);
    const double end_m = target_at_m(drive->target);
    const auto way_m = way_to_contact_m(way_, s_m, end_m, beside_m, *thing);
    if (!way_m) {
      const double least_m = nearest_on_way_m(way_, s_m, end_m, beside_m, *thing);
      one.where =
          least_m > kMargin_m + kBlur_m ? Appeared::Where::beside : Appeared::Where::grazing;
    } else {
      one.way_m = *way_m;
      one.where = pose.moves() ? judge_distance(*way_m, pose.vx_mps) : Appeared::Where::at_rest;
    }
    if (one.where == Appeared::Where::near) judge_zero(one);
    if (one.where == Appeared::Where::far) judge_standing(one, *drive, *thing);
    report_.appeared.push_back(one);
  }

  void judge_zero(const Appeared& one) {
    const auto moving = log_.moving(one.time + 100ms, std::min(one.gone, one.time + 2s));
    if (!moving.empty())
      problem(one, "is driven on for after 100 ms: " + seconds(moving.front().time));
  }

  /// When it is taken away and the robot stands before nothing else, nor did just now.
  void judge_standing(Appeared& one, const Drive& drive, const Flat& thing) {
    const Time then = one.gone - 20ms;
    if (then > drive.end || then < one.time + 1500ms) return;
    const TruePose& pose = scene_.pose_at(then);
    const TruePose& earlier = scene_.pose_at(then - 1s);
    if (pose.moves() || std::hypot(pose.x_m - earlier.x_m, pose.y_m - earlier.y_m) > kStanding_mps)
      return;
    double s_m = 0;
    double beside_m = 0;
    locate(pose, drive, s_m, beside_m);
    const double end_m = target_at_m(drive.target);
    const auto way_m = way_to_contact_m(way_, s_m, end_m, beside_m, thing);
    if (!way_m) return;  // it stands at its goal
    if (stands_before_other(pose, one.name)) return;
    one.stood_m = *way_m;
    if (*way_m > kFarFrom_m + kBlur_m)
      problem(one, "is stood before at " + std::to_string(*way_m) + " m, that is too far");
    bool told = false;
    for (const auto& status : log_.statuses)
      told = told || (status.time > then - 1s && status.time <= one.gone && status.obstacle &&
                      status.why.find(one.name) != std::string::npos);
    if (!told) problem(one, "is stood before and not named");
  }

  /// Or stood until so short a time ago that it need not move yet.
  bool stands_before_other(TruePose pose, const std::string& name) const {
    for (const Time then = pose.time; pose.time > then - kAgain; pose.time -= 20ms)
      for (const auto& other : gaps_at(pose, scene_.objects))
        if (other.what != name && other.gap_m < kFarFrom_m + kBlur_m) return true;
    return false;
  }

  /// What appeared too near to stop may be run into while it brakes; nothing else.
  bool is_excused(const std::string& name) const {
    return std::any_of(report_.appeared.begin(), report_.appeared.end(), [&](const Appeared& one) {
      return one.name == name &&
             (one.where == Appeared::Where::near || one.where == Appeared::Where::between);
    });
  }

  void judge_contacts() {
    report_.poses = scene_.poses.size();
    Around around(scene_.objects);
    std::set<std::string> met;  // each is told once
    for (const auto& pose : scene_.poses) {
      if (!pose.moves()) continue;
      for (const auto& one : around.gaps(pose)) {
        const bool excused = is_excused(one.what);
        if (!excused) report_.least_gap_m = std::min(report_.least_gap_m, one.gap_m);
        if (!(one.gap_m < 0) || !met.insert(one.what).second) continue;
        if (excused)
          ++report_.excused_contacts;
        else
          report_.problems.push_back(one.what + ": CONTACT at " + seconds(one.time) + " at " +
                                     std::to_string(pose.vx_mps) + " m/s");
      }
    }
  }

  /// The mechanics say the same.
  void judge_touches() {
    for (const auto& touch : scene_.all("touch")) {
      ++report_.touches;
      if (is_excused(touch.name)) continue;
      const bool moved =
          std::abs(touch.numbers[3]) > kStanding_mps || std::abs(touch.numbers[5]) > 0.01;
      if (moved)
        report_.problems.push_back(touch.name + ": the mechanics felt a CONTACT at " +
                                   seconds(touch.time));
    }
  }

  void problem(const Appeared& one, const std::string& what) {
    report_.problems.push_back(one.name + " (" + one.kind + ", " + word(one.where) + ", " +
                               std::to_string(one.way_m) + " m at " + std::to_string(one.v_mps) +
                               " m/s, " + seconds(one.time) + ") " + what);
  }

  const Record& log_;
  SceneLog scene_;
  Way way_;
  std::vector<Drive> drives_;
  SeriesReport report_;
};

}  // namespace

SeriesReport judge_series(const Record& record) {
  return Series(record).judge_all();
}

void SeriesProof::add(const SeriesReport& report) {
  drives += report.drives;
  far += report.count(Appeared::Where::far);
  near += report.count(Appeared::Where::near);
  stood += static_cast<std::size_t>(
      std::ranges::count_if(report.appeared, [](const Appeared& one) { return one.stood_m >= 0; }));
}

std::vector<std::string> SeriesProof::lacks() const {
  constexpr std::size_t kSeries = 100;
  // Of those that appear far enough away two in five are still there when it comes to them; before
  // some of those it stands too short a time, or before something else.
  constexpr std::size_t kOneIn = 6;
  std::vector<std::string> lacks;
  if (drives < kSeries) return lacks;
  if (stood == 0 || kOneIn * stood < far)
    lacks.push_back("only before " + std::to_string(stood) + " of " + std::to_string(far) +
                    " things that came far enough away the robot was seen to stand");
  if (near == 0) lacks.push_back("nothing came too near to stop before it");
  return lacks;
}

std::size_t SeriesReport::count(Appeared::Where where) const {
  return static_cast<std::size_t>(
      std::count_if(appeared.begin(), appeared.end(),
                    [where](const Appeared& one) { return one.where == where; }));
}

}  // namespace drover::mission
