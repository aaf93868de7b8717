#include "runtime/publish_loop.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "engine/base/kinematics.h"
#include "publish/cli_outlet.h"
#include "publish/ros2_outlet.h"
#include "publish/status/seen.h"
#include "runtime/clock.h"
#include "runtime/learned_subject.h"
#include "runtime/log.h"
#include "runtime/outlets.h"

namespace drover::runtime {

namespace {

constexpr Duration kTenth = std::chrono::milliseconds(100);

/// From kOutlets on: the timers of the outlets.
enum Tag : std::uint64_t {
  kTimer = 1,
  kBroker,
  kCli,
  kEvents,
  kReplies,
  kParsed,
  kStops,
  kScene,
  kSceneParsed,
  kOutlets
};

/// A timer that is readable so often a second.
link::UniqueFd periodic_timer(Duration period) {
  link::UniqueFd timer(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
  const auto ns = static_cast<long>(period.count());
  const itimerspec each{{ns / 1'000'000'000, ns % 1'000'000'000},
                        {ns / 1'000'000'000, ns % 1'000'000'000}};
  if (!timer || ::timerfd_settime(timer.get(), 0, &each, nullptr) != 0)
    throw std::runtime_error("the publish thread's timer cannot be set");
  return timer;
}

void clear_timer(const link::UniqueFd& timer) {
  std::uint64_t expirations = 0;
  (void)!::read(timer.get(), &expirations, sizeof expirations);
}

}  // namespace

PublishLoop::PublishLoop(const config::DroverConfig& config, ControlExchange& control,
                         StorageExchange& storage, ParserLoop& parser,
                         const std::optional<ScenePartners>& scene, StopListener* stops,
                         store::StoredState stored,
                         const std::optional<store::KeptLearned>& learned,
                         publish::ConfigurationTexts texts,
                         std::span<const std::unique_ptr<ScanLink>> scanners)
    : config_(config),
      control_(control),
      storage_(storage),
      parser_(parser),
      scene_(scene),
      stops_(stops),
      scanners_(scanners),
      stop_order_(stops),
      service_(service_config(config), std::move(stored)),
      joint_commands_(joint_commands_config(config)),
      started_(monotonic_now()),
      cli_(
          config.paths.run + "/drover.sock",
          [this](publish::ClientId client, std::string_view line) { on_line(client, line); },
          scene ? publish::SceneRequests::kLongLine : std::string_view()),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      timer_(periodic_timer(kTenth)) {
  if (!epoll_) throw std::runtime_error("the publish thread's epoll cannot be made");
  cli_.stops_first(publish::is_stop_line, control_.stops);
  cli_.on_gone([this](publish::ClientId client) {
    for (const auto& each : outlets_) each.outlet->on_gone(client);
  });
  watch(timer_.get(), kTimer);
  watch(cli_.fd(), kCli);
  watch(control_.events_ready.fd(), kEvents);
  watch(storage_.replies_ready.fd(), kReplies);
  watch(parser_.replies_ready().fd(), kParsed);
  if (stops_ != nullptr) watch(stops_->heard_ready().fd(), kStops);
  if (scene_) {
    watch(scene_->exchange.replies_ready.fd(), kScene);
    watch(scene_->parser.replies_ready().fd(), kSceneParsed);
  }
  const store::StoredScene none;  // the other is up to 16 MiB: no copy
  auto of_scene =
      std::make_unique<publish::SceneOutlet>(scene_.has_value(), scene_ ? *scene_->stored : none,
                                             [this](Time now) { return robot_now(now); });
  scene_outlet_ = of_scene.get();
  add(std::move(of_scene));  // before the command line, which takes every line
  auto of_reports = std::make_unique<publish::ReportOutlet>(service_);
  report_outlet_ = of_reports.get();
  add(std::move(of_reports));
  auto of_learned = std::make_unique<publish::LearnedOutlet>(learned_beside(config), learned);
  learned_outlet_ = of_learned.get();
  add(std::move(of_learned));
  add(std::make_unique<publish::HandOutlet>(std::move(texts),
                                            [this](Time now) { return seen(now); }));
  if (config.ros2.configured && config.ros2.mode != "off")
    add(std::make_unique<publish::Ros2Outlet>(
        config.ros2.rate_Hz,
        [this] {
          std::vector<const scene::sensor::SeenTurn*> turns;
          for (const auto& scanner : scanners_)
            turns.push_back(&scanner->exchange.shown_turn.latest());
          return turns;
        },
        publish::Ros2Inputs{config.ros2.inputs.cmd_vel != "closed",
                            engine::limits(engine::kinematics_of(config.engine.base)).sideways,
                            config.ros2.inputs.joint_command ? &joint_commands_ : nullptr,
                            &scene_outlet_->topics(), config.ros2.inputs.collision_object,
                            config.ros2.inputs.planning_constraints}));
  for (auto& outlet : make_outlets(config, service_, joint_commands_,
                                   [this](Time now) { return status_text(now); }))
    add(std::move(outlet));
  if (config.mqtt.enabled) connect_broker();
}

void PublishLoop::add(std::unique_ptr<publish::Outlet> outlet) {
  link::UniqueFd timer;
  if (outlet->period() > Duration::zero()) {
    timer = periodic_timer(outlet->period());
    watch(timer.get(), kOutlets + outlets_.size());
  }
  outlets_.push_back({std::move(outlet), std::move(timer)});
}

void PublishLoop::connect_broker() {
  std::vector<MqttSubscription> subscriptions;
  for (const auto& each : outlets_)
    for (const auto& topic : each.outlet->wants()) subscriptions.push_back({topic.name, topic.qos});
  broker_ = std::make_unique<MqttClient>(
      config_.mqtt, std::move(subscriptions),
      [this](const MqttMessage& message) { on_message(message); },
      [this](bool connected, const std::string& text) {
        broker_text_ = connected ? "" : text;
        log(connected ? LogLevel::info : LogLevel::warning, text);
      });
}

void PublishLoop::watch(int fd, std::uint64_t tag) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = tag;
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0)
    throw std::runtime_error("the publish thread cannot wait for what it has to hear");
}

/// A new connection may have the old one's descriptor number, hence their count.
void PublishLoop::watch_broker() {
  const int fd = broker_ ? broker_->fd() : -1;
  if (fd < 0) return;
  const BrokerWatch wanted{fd, broker_->connections(), broker_->wants_write()};
  if (wanted == broker_watch_) return;
  if (wanted.connection != broker_watch_.connection) stop_order_.begin_anew(monotonic_now());
  broker_watch_ = wanted;
  epoll_event event{};
  event.events = EPOLLIN | (wanted.writing ? EPOLLOUT : 0U);
  event.data.u64 = kBroker;
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, fd, &event) != 0)
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
}

void PublishLoop::run(const std::atomic<bool>& stop) {
  wall_minus_monotonic_ = wall_minus_monotonic();
  service_.begin(monotonic_now(), actions_);
  carry_out(actions_);
  if (broker_) broker_->tick(monotonic_now());
  std::array<epoll_event, 8> events{};
  while (!stop.load(std::memory_order_relaxed)) {
    watch_broker();
    if (broker_) service_.set_under_way(broker_->bytes_under_way());
    const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), 1000);
    const Time now = monotonic_now();
    for (int i = 0; i < n; ++i) {
      switch (events[i].data.u64) {
        case kTimer:
          clear_timer(timer_);
          each_tenth(now);
          break;
        case kBroker:
          if ((events[i].events & EPOLLOUT) != 0) broker_->on_writable(now);
          if ((events[i].events & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) broker_->on_readable(now);
          break;
        case kCli: cli_.on_ready(); break;
        case kEvents:
          control_.events_ready.clear();
          take_events();
          break;
        case kReplies:
          storage_.replies_ready.clear();
          take_replies(now);
          break;
        case kParsed:
          parser_.replies_ready().clear();
          take_parsed(now);
          break;
        case kScene:
          scene_->exchange.replies_ready.clear();
          take_scene(now);
          break;
        case kSceneParsed:
          scene_->parser.replies_ready().clear();
          take_scene_texts(now);
          break;
        case kStops:
          stops_->heard_ready().clear();
          take_heard_stops(now);
          break;
        default: {
          TimedOutlet& due = outlets_.at(events[i].data.u64 - kOutlets);
          clear_timer(due.timer);
          tell(*due.outlet, now);
        }
      }
      carry_out(actions_);
    }
    turns_.fetch_add(1, std::memory_order_relaxed);
  }
}

void PublishLoop::each_tenth(Time now) {
  wall_minus_monotonic_ = wall_minus_monotonic();
  if (broker_) broker_->tick(now);
  tell_whether_stops_are_heard(now);
  send_unsent();
  refuse_late_starts(now);
  // Also when the ring of events was full; what comes in its place has had the time for it.
  answer_stops(obeyed_stops_, now);
  obeyed_stops_ = control_.stops.obeyed();
}

void PublishLoop::tell(publish::Outlet& outlet, Time now) {
  if (control_.snapshot.latest().time == kNever) return;  // no first cycle yet
  if (outlet.needs_broker() && !(broker_ && broker_->connected())) return;
  const auto messages = outlet.on_snapshot(seen(now), {now, wall_minus_monotonic_}, actions_);
  if (!broker_) return;
  for (const auto& [topic, payload] : messages) broker_->publish_latest(topic, payload);
}

/// Longer than the guard waits before it takes the bus: then nothing of the old is true.
Snapshot PublishLoop::seen(Time now) {
  const Duration limit = std::max<Duration>(publish::kSnapshotLimit,
                                            std::chrono::milliseconds(config_.guard.limit_ms));
  auto snapshot = publish::as_seen(control_.snapshot.latest(), now, limit);
  // They are told by threads of their own, whatever the control thread does.
  for (const auto& scanner : scanners_) {
    const ScanTold& told = scanner->exchange.told.latest();
    (void)snapshot.scanners.push_back(as_shown(told, now));
    (void)snapshot.links.push_back(told.link);
  }
  if (!service_.origin_problem().empty()) publish::tell_first(snapshot, service_.origin_problem());
  for (const auto& each : outlets_)
    if (const auto trouble = each.outlet->trouble(now); !trouble.empty())
      publish::tell_last(snapshot, trouble);
  if (const auto rivals = joint_commands_.rivals(now); !rivals.empty())
    publish::tell_last(snapshot, rivals);
  return snapshot;
}

std::string PublishLoop::status_text(Time now) {
  publish::DaemonStatus daemon;
  daemon.robot = config_.robot_name;
  daemon.broker_connected = broker_ && broker_->connected();
  daemon.broker_text = broker_ ? broker_text_ : "not configured";
  daemon.now = now;
  daemon.uptime_s = to_s(now - started_);
  daemon.telemetry_dropped = broker_ ? broker_->dropped() : 0;
  daemon.answers_lost = lost_answers_ + (stops_ != nullptr ? stops_->lost_answers() : 0);
  daemon.joint_commands_unread = joint_commands_.unread();
  daemon.joint_commands_rivals = joint_commands_.rivals(now);
  daemon.joint_commands_of_rivals = joint_commands_.rivals_refused();
  for (const auto& each : outlets_) each.outlet->count(daemon);
  daemon.events_lost = control_.lost_events.load(std::memory_order_relaxed);
  daemon.stop_trouble = storage_.stop_trouble.latest().view();
  return publish::status_json(seen(now), daemon);
}

/// At once: a stop must not wait for what else woke the thread.
void PublishLoop::on_line(publish::ClientId client, std::string_view line) {
  before_ = cli_.before();
  for (const auto& each : outlets_)
    if (each.outlet->on_line(client, line, monotonic_now(), actions_)) break;
  carry_out(actions_);
  before_.reset();
}

void PublishLoop::take_events() {
  Event event;
  while (control_.events.pop(event)) {
    const auto* accepted = std::get_if<CommandAccepted>(&event.body);
    // In the place where the engine answered, so that operators read answers in order.
    const auto obeyed = accepted != nullptr ? obeyed_with(accepted->id) : std::nullopt;
    if (obeyed) {
      told_stops_ = *obeyed;
      answer_stops(told_stops_, event.time);
    }
    for (const auto& each : outlets_) each.outlet->on_event(event, actions_);
  }
}

void PublishLoop::take_replies(Time now) {
  store::StorageReply reply;
  while (storage_.replies.pop(reply)) stored(std::move(reply), now, actions_);
}

void PublishLoop::stored(store::StorageReply reply, Time now, publish::Actions& actions) {
  if (reply.whose == store::StoredFor::scene) {
    scene_outlet_->on_stored(reply, now, actions);
  } else if (reply.whose == store::StoredFor::reports) {
    report_outlet_->on_stored(reply, actions);
  } else if (reply.whose == store::StoredFor::learned) {
    learned_outlet_->on_stored(reply, actions);
  } else {
    service_.on_reply(std::move(reply), now, actions);
  }
}

}  // namespace drover::runtime
