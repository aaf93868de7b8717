#include "mission/arm_wire.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace drover::mission {
namespace {

using namespace std::chrono_literals;
using damiao::Answer;
using damiao::SetPoint;
using nlohmann::json;

/// Of droverd: what it counts in is not quite what is seen on the wire.
constexpr Duration kCycle = 5ms;
/// A position is cut off at the motor's last bit.
constexpr double kStep_rad = damiao::kLeast_rad + 1e-5;
/// Where a joint is: it may have moved a bit since it told, and both are cut off.
constexpr double kSame_rad = 0.001;
/// What a motor makes of a set point that is somewhere else, but means the same. Of a joint that
/// moves, what was measured is a cycle old.
constexpr double kSame_Nm = 0.3;
/// The motors' time-out is 100 ms.
constexpr Duration kFed = 50ms;

bool of_arm(const CanLine& line) {
  return line.bus == "can1";
}

double torque_Nm(const SetPoint& told, const Answer& at) {
  return told.stiffness * (told.position_rad - at.position_rad) +
         told.damping * (told.velocity_radps - at.velocity_radps) + told.torque_Nm;
}

/// One joint, along the record.
class Joint final {
 public:
  Joint(std::size_t number, const ArmBounds& bounds, double stiffest)
      : number_(number), bounds_(bounds), stiffest_(std::max(stiffest, bounds.stiffness)) {}

  void hear(const Answer& answer) { at_ = answer; }
  void judge(Time time, const SetPoint& told, Problems& problems) {
    if (last_ && told.stiffness > 0) {
      const double dt_s = to_s(time - last_->time);
      if (last_->told.stiffness > 0)
        judge_step(time, told, dt_s, problems);
      else
        judge_begin(time, told, problems);
      judge_rise(time, told, dt_s, problems);
    } else if (told.stiffness > 0) {
      tell(time, "is stiff at once", problems);
    }
    last_ = ArmSetPoint{time, told};
  }

 private:
  void tell(Time time, const std::string& what, Problems& problems) const {
    add(problems, seconds(time) + ": joint " + std::to_string(number_) + " " + what);
  }

  void judge_step(Time time, const SetPoint& told, double dt_s, Problems& problems) const {
    const double step_rad = std::abs(told.position_rad - last_->told.position_rad);
    if (step_rad <= bounds_.max_velocity_radps * dt_s + kStep_rad) return;
    const double step_Nm = at_ ? torque_Nm(told, *at_) - torque_Nm(last_->told, *at_) : NAN;
    if (std::abs(step_Nm) < kSame_Nm) return;
    tell(time,
         "steps by " + std::to_string(step_rad) + " rad in " + std::to_string(dt_s) +
             " s, and by " + std::to_string(step_Nm) + " Nm",
         problems);
  }

  void judge_begin(Time time, const SetPoint& told, Problems& problems) const {
    const double off_rad = at_ ? told.position_rad - at_->position_rad : NAN;
    if (std::abs(off_rad) < kSame_rad) return;
    tell(time, "begins " + std::to_string(off_rad) + " rad from where it is", problems);
  }

  void judge_rise(Time time, const SetPoint& told, double dt_s, Problems& problems) const {
    const double most = stiffest_ / bounds_.rise_s * (dt_s + to_s(kCycle)) + damiao::kLeast_Nmprad;
    const double rose = told.stiffness - last_->told.stiffness;
    if (rose > most)
      tell(time, "is stiffer by " + std::to_string(rose) + " Nm/rad at once", problems);
  }

  std::size_t number_;
  ArmBounds bounds_;
  double stiffest_;
  std::optional<ArmSetPoint> last_;
  std::optional<Answer> at_;
};

double stiffest(const Record& record, std::size_t joint) {
  double most = 0;
  for (const ArmSetPoint& one : arm_set_points(record, joint))
    most = std::max(most, one.told.stiffness);
  return most;
}

/// Where it began, it has come up when its time is over.
void judge_risen(const Record& record, std::size_t joint, const ArmBounds& bounds,
                 Problems& problems) {
  const auto all = arm_set_points(record, joint);
  const auto at = [&all](Time time) {
    return std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.time >= time; });
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].told.stiffness == 0 || all[i - 1].told.stiffness > 0) continue;
    const Time risen = all[i].time + from_s(bounds.rise_s) + 10 * kCycle;
    const auto then = at(risen);
    const auto later = at(risen + from_s(bounds.rise_s));
    if (later == all.end() || std::any_of(all.begin() + static_cast<std::ptrdiff_t>(i), later,
                                          [](auto& one) { return one.told.stiffness == 0; }))
      continue;
    if (later->told.stiffness > then->told.stiffness + damiao::kLeast_Nmprad)
      add(problems, seconds(risen) + ": joint " + std::to_string(joint) + " has not come up yet");
  }
}

}  // namespace

std::vector<ArmSetPoint> arm_set_points(const Record& record, std::size_t joint, Time begin,
                                        Time end) {
  std::vector<ArmSetPoint> found;
  for (const CanLine& line : record.can) {
    if (!of_arm(line) || line.time < begin || line.time > end) continue;
    const auto told = damiao::set_point(line.frame);
    if (told && told->joint == joint) found.push_back({line.time, *told});
  }
  return found;
}

AllArmBounds read_arm_bounds(const std::string& scenario) {
  const json whole = read_scenario(scenario);
  auto file = std::filesystem::path(DROVER_SOURCE_DIR) / "sim/scenarios" /
              whole.at("robot").get<std::string>();
  std::ifstream stream(file.replace_extension(".drover.json"));
  auto config = json::parse(stream, nullptr, true, true);
  config.merge_patch(whole.value("gateway", json::object()));
  AllArmBounds bounds;
  for (const auto& [name, rules] : config.at("groups").at("arm").at("joints").items()) {
    const auto id = config.at("devices").at(name).at("options").at("id").get<std::size_t>();
    bounds.at(id - 1) = {rules.at("max_velocity_radps").get<double>(),
                         rules.value("stiffness_Nmprad", 20.0), rules.value("rise_s", 0.5)};
  }
  return bounds;
}

Problems check_arm_steps(const Record& record, const AllArmBounds& bounds) {
  Problems problems;
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    joints.emplace_back(i, bounds[i], stiffest(record, i));
  bool stiff = false;
  for (const CanLine& line : record.can) {
    if (!of_arm(line)) continue;
    if (const auto answer = damiao::answer(line.frame)) joints[answer->joint].hear(*answer);
    const auto told = damiao::set_point(line.frame);
    if (!told) continue;
    joints[told->joint].judge(line.time, *told, problems);
    stiff = stiff || told->stiffness > 0;
  }
  for (std::size_t i = 0; i < bounds.size(); ++i) judge_risen(record, i, bounds[i], problems);
  if (!stiff) add(problems, "no motor was ever told to hold");
  return problems;
}

Problems check_arm_only_damped(const Record& record, Time begin, Time end) {
  Problems problems;
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint) {
    const std::string name = ": joint " + std::to_string(joint);
    Time last = begin;
    for (const ArmSetPoint& one : arm_set_points(record, joint, begin, end)) {
      if (!one.told.only_damps()) add(problems, seconds(one.time) + name + " is told to move");
      if (one.time - last > kFed) add(problems, seconds(last) + name + " is told nothing");
      last = one.time;
    }
    if (end - last > kFed) add(problems, seconds(last) + name + " is told nothing");
  }
  return problems;
}

}  // namespace drover::mission
