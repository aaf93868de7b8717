// The publish thread: broker, command line and the engine's events meet here. Never waits for the
// disk.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "publish/aimrt/joint_commands.h"
#include "publish/command_service.h"
#include "publish/hand_outlet.h"
#include "publish/learned_outlet.h"
#include "publish/outlet.h"
#include "publish/report_outlet.h"
#include "publish/scene_outlet.h"
#include "runtime/cli_server.h"
#include "runtime/control_exchange.h"
#include "runtime/mqtt_client.h"
#include "runtime/parser_loop.h"
#include "runtime/scan_loop.h"
#include "runtime/scene_exchange.h"
#include "runtime/start_checks.h"
#include "runtime/stop_listener.h"
#include "runtime/stop_order.h"
#include "runtime/storage_loop.h"

namespace drover::runtime {

/// What the publish thread needs of the scene's.
struct ScenePartners {
  SceneExchange& exchange;
  SceneParserLoop& parser;
  std::shared_ptr<const store::StoredScene> stored;
};

class PublishLoop final {
 public:
  /// `stops`: nullptr without a broker; `scene`: nothing without a scene. Throws std::runtime_error
  /// when its socket cannot be opened.
  PublishLoop(const config::DroverConfig& config, ControlExchange& control,
              StorageExchange& storage, ParserLoop& parser,
              const std::optional<ScenePartners>& scene, StopListener* stops,
              store::StoredState stored, const std::optional<store::KeptLearned>& learned,
              publish::ConfigurationTexts texts,
              std::span<const std::unique_ptr<ScanLink>> scanners = {});
  void run(const std::atomic<bool>& stop);
  /// Wakes the loop so that it sees `stop`.
  void wake() const { control_.events_ready.notify(); }
  /// Counts once a turn, at least ten times a second: a supervisor sees whether the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

 private:
  /// What epoll knows of the broker's connection.
  struct BrokerWatch {
    int fd = -1;
    std::uint64_t connection = 0;
    bool writing = false;
    bool operator==(const BrokerWatch&) const = default;
  };

  /// With the timer of its rate.
  struct TimedOutlet {
    std::unique_ptr<publish::Outlet> outlet;
    link::UniqueFd timer;
  };

  void watch(int fd, std::uint64_t tag);
  void add(std::unique_ptr<publish::Outlet> outlet);
  void watch_broker();
  void connect_broker();
  void on_message(const MqttMessage& message);
  void on_control(std::string_view payload, const publish::Arrival& arrival, Time now);
  void take_parsed(Time now);
  void ask_again(const publish::ControlCommand& request, Time first);
  void await_other_self();
  void take_heard_stops(Time now);
  void tell_whether_stops_are_heard(Time now);
  void each_tenth(Time now);
  void tell(publish::Outlet& outlet, Time now);
  Snapshot seen(Time now);
  void take_events();
  void take_replies(Time now);
  void stored(store::StorageReply reply, Time now, publish::Actions& actions);
  void take_scene(Time now);
  void take_scene_texts(Time now);
  void give(publish::SceneJob job, publish::Actions& actions);
  void give(publish::SceneTextJob job, publish::Actions& actions);
  publish::RobotNow robot_now(Time now);
  void on_line(publish::ClientId client, std::string_view line);
  std::string status_text(Time now);
  void carry_out(publish::Actions& actions);
  void send_with_others(const publish::PublishText& message, publish::Actions& actions);
  void send_unsent();
  void send(const publish::PublishText& message, publish::Actions& actions);
  void deliver(const Command& command, publish::Actions& actions);
  void push(const Command& command, const StopCounts& before, publish::Actions& actions);
  void check_start(const Command& command, const StopCounts& before, Time now,
                   publish::Actions& actions);
  void checked(std::uint64_t number, const publish::TrackChecked& found);
  void refuse_late_starts(Time now);
  void answer_stops(const StopCounts& obeyed, Time now);

  const config::DroverConfig& config_;
  ControlExchange& control_;
  StorageExchange& storage_;
  ParserLoop& parser_;
  std::optional<ScenePartners> scene_;
  StopListener* stops_;
  std::span<const std::unique_ptr<ScanLink>> scanners_;
  StopOrder stop_order_;
  std::uint64_t lost_answers_ = 0;  ///< that neither connection takes
  Time next_wait_ = kNever;         ///< for the other self of a stop, not before
  Time last_delivered_ = kNever;    ///< a command that is no stop
  // Of what is carried out just now, when it is not what the present tells:
  std::optional<StopCounts> before_;  ///< it waited for the parser since
  std::optional<StopCounts> asked_;   ///< a stop, and what was asked for with it
  StartChecks starts_;
  Time last_start_ = kNever;  ///< of a task or a search for the heading, delivered
  publish::CommandService service_;
  publish::aimrt::JointCommands joint_commands_;  ///< by whichever way they come
  publish::Actions actions_;
  std::vector<TimedOutlet> outlets_;
  publish::SceneOutlet* scene_outlet_ = nullptr;    ///< one of them
  publish::ReportOutlet* report_outlet_ = nullptr;  ///< likewise
  publish::LearnedOutlet* learned_outlet_ = nullptr;
  Time started_;
  std::string broker_text_;
  std::unique_ptr<MqttClient> broker_;
  BrokerWatch broker_watch_;
  Duration wall_minus_monotonic_{};  ///< ten times a second
  CliServer cli_;
  StopCounts told_stops_;    ///< by the engine's events so far
  StopCounts obeyed_stops_;  ///< 0.1 s ago, whether told or not
  link::UniqueFd epoll_;
  link::UniqueFd timer_;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
