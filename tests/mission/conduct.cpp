// Frames, motion, position: what the CAN log and the truth say together.
#include "mission/conduct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mission/wire_cia402.h"
#include "mission/wire_cubemars_mit.h"
#include "mission/wire_damiao.h"
#include "mission/wire_robomaster.h"
#include "mission/wire_twist.h"
#include "mission/wire_zlac8015d.h"

namespace drover::mission {
namespace {

using namespace std::chrono_literals;

// A publisher looks at the snapshot each few milliseconds, and a frame waits for its cycle.
constexpr Duration kAnnounced = 100ms;
// An AgileX gets zeros for so long before any motion (drivers/agilex_v2/README.md).
constexpr Duration kZerosFirst = 200ms;
// From the highest speed to rest: 0.8 m/s at 0.8 m/s^2, the jerk limit's 0.4 s, and a margin.
constexpr Duration kRamp = 1600ms;
constexpr Duration kGuard = 100ms;

bool is_agilex(Maker maker) {
  return maker == Maker::agilex_v2 || maker == Maker::hunter;
}

/// A task: from the operator's start to the end that the gateway told.
struct Task {
  Time begin = kNever;
  Time end = Time::max();
};

Time asked(const Record& record, Time answered) {
  Time time = kNever;
  for (const auto& line : record.mqtt)
    if (line.time <= answered && line.topic == "mqtt_control" &&
        line.payload.find("\"start_task\"") != std::string::npos)
      time = line.time;
  return time;
}

/// Together with the guard, which then stops nothing: droverd has to, as soon as it goes on.
bool hung_with_guard(const Record& record, Time stopped) {
  const auto times = record.all("signal 19 to drover-guard");
  return std::any_of(times.begin(), times.end(), [stopped](Time time) {
    return time >= stopped - 5ms && time <= stopped + 5ms;
  });
}

/// The last instant at which the task may still move the wheels.
Time last_motion(const Record& record, Time answered) {
  Time end = Time::max();
  bool ran = false;
  for (const auto& status : record.statuses) {
    if (status.time < answered) continue;
    ran = ran || status.nav == "NAV_RUN";
    const bool ended = status.nav == "NAV_SUCCESS" || status.nav == "NAV_ERROR" ||
                       (ran && status.nav != "NAV_RUN");
    if (!ended) continue;
    end = status.nav == "NAV_SUCCESS" ? status.time : status.time + kRamp;
    break;
  }
  for (const auto* text : {"signal 9 to droverd", "signal 19 to droverd"})
    for (const Time killed : record.all(text))
      if (killed > answered && !hung_with_guard(record, killed))
        end = std::min(end, killed + kGuard);
  return end;
}

std::vector<Task> tasks(const Record& record) {
  std::vector<Task> found;
  for (const auto& one : record.feedback)
    if (one.cmd == "start_task_success")
      found.push_back({asked(record, one.time), last_motion(record, one.time)});
  return found;
}

/// A person's search for the heading: from the request for as long as the gateway says that it has
/// the drives, and a ramp.
std::vector<Task> searches(const Record& record) {
  constexpr Duration kFirst = 1s;
  std::vector<Task> found;
  for (const Time begin : record.all("start drover heading find")) {
    Task search{begin, begin};
    for (const auto& status : record.statuses) {
      if (status.time < begin) continue;
      const bool has_drives = status.document.at("nav").at("owner") == "manual";
      if (has_drives) search.end = status.time + kRamp;
      if (!has_drives && (search.end != begin || status.time > begin + kFirst)) break;
    }
    found.push_back(search);
  }
  return found;
}

/// Ramps to rest of drives that hold the robot again: no faster than it rolls, and only slower.
class Ramps {
 public:
  explicit Ramps(const Record& record) : record_(record) {}
  /// Set points in the order of their times.
  bool slows(const Sent& one) {
    constexpr double kSlip_mps = 0.1;
    constexpr double kStands_mps = 0.02;  // at the end of a ramp the body swings back
    constexpr Duration kNew = 100ms;
    Sent& last = last_.at(one.wheel.node % last_.size());
    const bool goes_on = one.time - last.time < kNew;
    const bool grows = goes_on && std::abs(one.wheel.velocity_turnps) >
                                      std::abs(last.wheel.velocity_turnps) + 1e-3;
    last = one;
    if (record_.truth.empty() || one.time > record_.truth.back().time || one.wheel.torque_Nm != 0)
      return false;
    const double rolls_mps = record_.truth_at(one.time).vx_mps;
    const double asked_mps = one.wheel.velocity_turnps * record_.mps_per_turnps;
    const bool same_way = asked_mps * rolls_mps >= 0 || std::abs(asked_mps) < kStands_mps;
    return !grows && same_way && std::abs(asked_mps) <= std::abs(rolls_mps) + kSlip_mps;
  }

 private:
  const Record& record_;
  std::array<Sent, 8> last_{};
};

bool inside(const std::vector<Task>& tasks, Time time) {
  return std::any_of(tasks.begin(), tasks.end(),
                     [time](const Task& task) { return time >= task.begin && time <= task.end; });
}

}  // namespace

void add(Problems& problems, std::string text) {
  constexpr std::size_t kEnough = 10;
  if (problems.size() < kEnough) problems.push_back(std::move(text));
}

std::string seconds(Duration duration) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.6f s", to_s(duration));
  return text.data();
}
std::string seconds(Time time) {
  return seconds(time.time_since_epoch());
}

std::string judge(Maker maker, const CanFrame& frame) {
  switch (maker) {
    case Maker::odrive: return forbidden(frame);
    case Maker::zlac8015d: return zlac8015d::forbidden(frame);
    case Maker::gt01_can: return gt01::forbidden(frame);
    case Maker::agilex_v2: return agilex_v2::forbidden(frame);
    case Maker::hunter: return hunter::forbidden(frame);
    case Maker::robomaster: return robomaster::forbidden(frame);
    case Maker::cia402: return cia402::forbidden(frame);
    case Maker::gt01_serial: break;
  }
  return "it has no bus";
}

std::string judge(ArmMaker maker, const CanFrame& frame) {
  return maker == ArmMaker::damiao ? damiao::forbidden(frame) : cubemars_mit::forbidden(frame);
}

Problems check_frames(const Record& record) {
  Problems problems;
  std::size_t number = 0;
  for (const auto& line : record.can) {
    ++number;
    const bool of_arm = record.arm != ArmMaker::none && line.bus == "can1";
    const auto why = of_arm               ? judge(record.arm, line.frame)
                     : line.bus == "can0" ? judge(record.maker, line.frame)
                                          : "no bus of this robot";
    if (!why.empty()) add(problems, "can.log:" + std::to_string(number) + ": " + why);
  }
  // Half a packet of a program that died is none of another one's.
  constexpr std::size_t kHalfPackets = 17;
  if (record.maker == Maker::gt01_serial && gt01::read_line(record.folder).strange > kHalfPackets)
    add(problems, "serial.log: bytes that belong to no twist");
  if (record.sent.empty()) add(problems, "no set point was ever sent");
  return problems;
}

Problems check_motion(const Record& record, Holding holding) {
  Problems problems;
  const auto list = tasks(record);
  auto permitted = list;
  for (const auto& stream : streams(record.joint_commands))
    permitted.push_back({stream.begin, stream.last + kStreamTimeout + kRamp});
  const auto asked_for = searches(record);
  permitted.insert(permitted.end(), asked_for.begin(), asked_for.end());
  Ramps ramps(record);
  for (const auto& one : record.moving())
    if (!inside(permitted, one.time) && (holding == Holding::unmoved || !ramps.slows(one)))
      add(problems, seconds(one.time) + ": node " + std::to_string(one.wheel.node) +
                        " is told to move outside of any task and stream of joint commands");
  const Duration late = kAnnounced + (is_agilex(record.maker) ? kZerosFirst : 0ms);
  for (const auto& one : record.feedback) {
    if (one.cmd != "start_nav_success") continue;
    Time begin = kNever;
    for (const auto& task : list)
      if (task.begin <= one.time) begin = task.begin;
    const auto moved = record.moving(begin, Time::max());
    if (moved.empty() || moved.front().time > one.time + late ||
        moved.front().time < one.time - kAnnounced)
      add(problems, seconds(one.time) + ": start_nav_success, but the first motion was " +
                        (moved.empty() ? "never" : "at " + seconds(moved.front().time)));
  }
  return problems;
}

/// All encoders froze so shortly before that nothing can tell: drives that push on without them
/// gain 0.3 m in a quarter of a second, and the receiver tells of a place 0.08 s late, ten times a
/// second.
bool blinded(const Record& record, Time at) {
  const auto frozen = record.all("sim drive all fault stuck_encoder");
  return std::any_of(frozen.begin(), frozen.end(),
                     [at](Time since) { return at >= since && at - since < 300ms; });
}

/// From where it believes to be, in the simulator's frame. While the position is not good, and it
/// says so, it tells two places: what the receiver says as rtk, and a pose that goes on from the
/// last `good` one. It brakes then; that both are wrong would be another matter.
double error_m(const Status& status, const Status* good, const Place& truth) {
  const double told_m = distance_m(truth, status.sim);
  if (good == nullptr || status.locate == "LOCATE_TRUE") return told_m;
  const Place pose{good->sim.x_m + status.map.x_m - good->map.x_m,
                   good->sim.y_m + status.map.y_m - good->map.y_m};
  return std::min(told_m, distance_m(truth, pose));
}

Problems check_truth(const Record& record, double bound_m) {
  Problems problems;
  std::size_t looked = 0;
  auto sent = record.sent.begin();
  bool moves = false;
  const Status* good = nullptr;
  for (const auto& status : record.statuses) {
    if (status.locate == "LOCATE_TRUE") good = &status;
    for (; sent != record.sent.end() && sent->time <= status.time; ++sent)
      if (sent->wheel.node == kFirstNode) moves = sent->wheel.moves();
    if (!moves || !status.placed || status.time >= record.truth.back().time) continue;
    if (held_back(record, status.time) || blinded(record, status.time)) continue;
    ++looked;
    const auto truth = record.truth_at(status.time);
    const double off_m = error_m(status, good, {truth.x_m, truth.y_m});
    if (!(off_m <= bound_m))
      add(problems, seconds(status.time) + ": it moves and is " + std::to_string(off_m) +
                        " m from where it believes to be");
  }
  if (looked == 0) add(problems, "it never moved");
  return problems;
}

DriveFigures drive_figures(const Record& record, Time begin, Time end) {
  DriveFigures figures;
  Beside beside(record.track);
  const TruthLine* last = nullptr;
  double square_sum = 0;
  for (const auto& line : record.truth) {
    if (line.time < begin || line.time > end) continue;
    const Place at{line.x_m, line.y_m};
    const double off_m = beside.distance_m(at);
    const double way_m = last == nullptr ? 0 : distance_m(at, {last->x_m, last->y_m});
    figures.max_m = std::max(figures.max_m, off_m);
    figures.distance_m += way_m;
    square_sum += way_m * off_m * off_m;
    last = &line;
  }
  figures.rms_m = std::sqrt(square_sum / figures.distance_m);  // not a number: it never moved
  const Place at{record.truth.back().x_m, record.truth.back().y_m};
  figures.goal_m = record.target_id >= 1 && record.target_id <= record.track.size()
                       ? distance_m(at, record.track[record.target_id - 1])
                       : NAN;
  return figures;
}

PoseFigures pose_figures(const Record& record, Time begin, Time end) {
  constexpr double kMoves_mps = 0.02;
  PoseFigures figures;
  double count = 0;
  const Status* good = nullptr;
  for (const auto& status : record.statuses) {
    if (status.locate == "LOCATE_TRUE") good = &status;
    if (status.time < begin || status.time > end) continue;
    if (status.time >= record.truth.back().time) break;
    const auto truth = record.truth_at(status.time);
    if (std::abs(truth.vx_mps) < kMoves_mps || !status.placed) continue;
    if (held_back(record, status.time)) continue;
    const double off_m = error_m(status, good, {truth.x_m, truth.y_m});
    const double yaw_rad = status.document.at("pose").at("yaw").get<double>();
    const double error_deg =
        std::abs(std::remainder(yaw_rad - truth.yaw_rad, 2 * M_PI)) * 180 / M_PI;
    figures.rms_m += off_m * off_m;
    figures.rms_deg += error_deg * error_deg;
    figures.max_m = std::max(figures.max_m, off_m);
    figures.max_deg = std::max(figures.max_deg, error_deg);
    ++count;
  }
  figures.rms_m = std::sqrt(figures.rms_m / count);
  figures.rms_deg = std::sqrt(figures.rms_deg / count);
  return figures;
}

}  // namespace drover::mission
