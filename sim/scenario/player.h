// Plays a scenario: supervisor of the programs, operator, recorder.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sim/robot/log.h"
#include "sim/scenario/children.h"
#include "sim/scenario/mission.h"
#include "sim/scenario/operator_client.h"
#include "sim/scenario/robot_report.h"
#include "sim/scenario/story.h"
#include "sim/scenario/task_result.h"
#include "sim/scenario/view.h"
#include "sim/scenario/waits.h"
#include "sim/scenario/workplace.h"

namespace drover::sim {

enum class Outcome {
  as_expected = 0,
  otherwise = 1,  ///< the mission ended in another state than it should
  broken = 3,     ///< a program ended by itself
  timed_out = 4,
  interrupted = 130  ///< by a person
};

/// One thread and one poll(); the monotonic clock is the only one it reads.
class Player {
 public:
  Player(const Workplace& workplace, const Mission& mission, View& view);

  /// Starts everything and plays until the mission has ended; everything still runs then.
  Outcome play();
  /// Goes on, recording, until a signal comes.
  void keep_running();
  /// Ends every program. False: one did not end cleanly.
  bool finish();

  const TaskResult& result() const { return result_; }
  /// When it waited on its way.
  const std::vector<Waits::Wait>& waits() const { return waits_.all(); }
  /// What broke, empty when nothing did.
  const std::string& broken() const { return broken_; }
  /// Steps of the mission that never came, in words.
  std::vector<std::string> steps_left() const { return story_.left(); }

 private:
  bool going() const { return !interrupted_ && broken_.empty(); }
  void boot();
  void wait_for(const std::string& what, const std::function<bool()>& is_there);
  void start(const std::string& name, const std::vector<std::string>& words = {});
  void end_program(const std::string& name);
  bool turn(Time until);
  void poll_once(Duration wait);
  void collect_children();
  void take_steps(Time t);
  void act(const Action& action, Time now);
  void publish(const std::string& topic, const std::string& payload, bool retain = false);
  void publish_to_scene(const Action& action);
  void act_on_object(const ObjectSpec& spec, Time now);
  void act_on_zone(const ZoneSpec& zone);
  void tell_simulator(const std::string& command);
  void tell_journeys(Time now);
  void command_joints(Time t);
  void save_track();
  void start_task(const Action& action);
  void on_message(const MqttMessage& message);
  void happened(const std::string& event);
  void look_whether_ready();
  void start_when_ready(Time t);
  void look_for_end(const std::string& event);
  void tell(const std::string& text);

  const Workplace& workplace_;
  const Mission& mission_;
  View& view_;
  TextLog events_log_;
  TextLog mqtt_log_;
  link::UniqueFd signals_;
  Children children_;
  std::unique_ptr<HeldThread> frozen_;
  Story story_;
  CommandStream commands_;
  std::map<std::string, ObjectSpec> objects_;  // as they were told last, by id
  Journeys journeys_;
  RobotReport report_;
  Waits waits_;
  std::optional<OperatorClient> client_;
  bool was_subscribed_ = false;
  std::deque<std::vector<std::string>> calls_;  // of the command line, that wait for the one before
  std::set<std::string> killed_;                // whose end was asked for
  std::string broken_;                          // what ended by itself
  TaskResult result_;
  Time boot_{};
  Time end_ = Time::max();
  Time next_second_{};
  Time next_reconnect_{};
  bool started_ = false;         // by itself: `automatic`
  Time start_at_ = Time::max();  // when it will, if all is well then
  bool recording_ = true;
  bool interrupted_ = false;
};

}  // namespace drover::sim
