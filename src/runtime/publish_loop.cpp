#include "runtime/publish_loop.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "config/json_text.h"
#include "config/located_json.h"
#include "publish/rtk_navigation/trajectory_data.h"
#include "runtime/clock.h"
#include "runtime/log.h"

namespace drover::runtime {

namespace {

constexpr long kStatusPeriod_ns = 100'000'000;  // base_status: 10 Hz, RTK navigation protocol

enum Tag : std::uint64_t { kTimer = 1, kBroker, kCli, kEvents, kReplies };

publish::CommandServiceConfig service_config(const config::DroverConfig& config) {
  publish::CommandServiceConfig service;
  service.zero_based_ids = config.protocol.first_target_id == 0;
  service.automatic_origin = config.protocol.automatic_origin;
  service.antenna = {config.engine.estimate.antenna_x_m, config.engine.estimate.antenna_y_m};
  return service;
}

publish::RtkConfig rtk_config(const config::ProtocolConfig& protocol) {
  using publish::HeadingConvention;
  publish::RtkConfig rtk;
  if (protocol.heading == "counterclockwise_from_north")
    rtk.heading = HeadingConvention::counterclockwise_from_north;
  if (protocol.heading == "counterclockwise_from_east")
    rtk.heading = HeadingConvention::counterclockwise_from_east;
  if (protocol.power == "volts") rtk.power = publish::PowerUnit::volts;
  return rtk;
}

LogLevel log_level(Notice::Level level) {
  switch (level) {
    case Notice::Level::info: return LogLevel::info;
    case Notice::Level::warning: return LogLevel::warning;
    case Notice::Level::error: return LogLevel::error;
  }
  return LogLevel::error;
}

std::string refusal(std::string_view reason) {
  return json::JsonText()
      .open('{')
      .key("ok")
      .boolean(false)
      .key("reason")
      .text(reason)
      .close('}')
      .take();
}

double length_m(const store::Track& track) {
  double length = 0;
  for (std::size_t i = 1; i < track.points.size(); ++i)
    length += std::hypot(track.points[i].x_m - track.points[i - 1].x_m,
                         track.points[i].y_m - track.points[i - 1].y_m);
  return length;
}

}  // namespace

PublishLoop::PublishLoop(const config::DroverConfig& config, ControlExchange& control,
                         StorageExchange& storage, store::StoredState stored)
    : config_(config),
      control_(control),
      storage_(storage),
      service_(service_config(config), std::move(stored)),
      base_status_(rtk_config(config.protocol)),
      started_(monotonic_now()),
      cli_(config.paths.run + "/drover.sock",
           [this](CliServer::ClientId client, std::string_view line) {
             on_cli_line(client, line, monotonic_now());
           }),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK)) {
  const itimerspec period{{0, kStatusPeriod_ns}, {0, kStatusPeriod_ns}};
  if (!epoll_ || ::timerfd_settime(timer_.get(), 0, &period, nullptr) != 0)
    throw std::runtime_error("the publish thread's timer cannot be set");
  watch(timer_.get(), kTimer);
  watch(cli_.fd(), kCli);
  watch(control_.events_ready.fd(), kEvents);
  watch(storage_.replies_ready.fd(), kReplies);
  if (!config.mqtt.enabled) return;
  broker_ = std::make_unique<MqttClient>(
      config.mqtt, config.robot_name,
      [this](const MqttMessage& message) {
        if (message.topic == publish::kTopicControl)
          service_.on_control(message.payload, message.retained, monotonic_now(), actions_);
      },
      [this](bool connected, const std::string& text) {
        broker_text_ = connected ? "" : text;
        log(connected ? LogLevel::info : LogLevel::warning, text);
      });
}

void PublishLoop::watch(int fd, std::uint64_t tag) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = tag;
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
}

/// libmosquitto opens and closes its descriptor by itself, and a new one may have the old one's
/// number: ask epoll at every turn instead of remembering.
void PublishLoop::watch_broker() {
  const int fd = broker_ ? broker_->fd() : -1;
  if (fd < 0) return;
  epoll_event event{};
  event.events = EPOLLIN | (broker_->wants_write() ? EPOLLOUT : 0U);
  event.data.u64 = kBroker;
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, fd, &event) != 0)
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
}

void PublishLoop::run(const std::atomic<bool>& stop) {
  service_.begin(monotonic_now(), actions_);
  carry_out(actions_);
  if (broker_) broker_->tick(monotonic_now());
  std::array<epoll_event, 8> events{};
  while (!stop.load(std::memory_order_relaxed)) {
    watch_broker();
    const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), 1000);
    const Time now = monotonic_now();
    for (int i = 0; i < n; ++i) {
      switch (events[i].data.u64) {
        case kTimer: {
          std::uint64_t expirations = 0;
          (void)!::read(timer_.get(), &expirations, sizeof expirations);
          if (broker_) broker_->tick(now);
          publish_status(now);
          break;
        }
        case kBroker:
          if ((events[i].events & EPOLLOUT) != 0) broker_->on_writable();
          if ((events[i].events & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) broker_->on_readable();
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
        default: break;
      }
      carry_out(actions_);
    }
    if (cancel_wanted_.exchange(false, std::memory_order_relaxed)) {
      service_.on_cli(next_request_++, publish::CancelTaskRequest{}, now, actions_);
      carry_out(actions_);
    }
    turns_.fetch_add(1, std::memory_order_relaxed);
  }
}

void PublishLoop::publish_status(Time now) {
  const auto& snapshot = control_.snapshot.latest();
  if (snapshot.time == kNever) return;  // the control thread has not had its first cycle
  service_.on_snapshot(snapshot, now, actions_);
  if (broker_) {
    broker_->publish_latest(publish::kTopicBaseStatus.data(),
                            base_status_.text(snapshot, publish::BatteryState{}));
  }
}

void PublishLoop::take_events() {
  Event event;
  while (control_.events.pop(event)) service_.on_event(event, actions_);
}

void PublishLoop::take_replies(Time now) {
  store::StorageReply reply;
  while (storage_.replies.pop(reply)) service_.on_reply(reply, now, actions_);
}

void PublishLoop::carry_out(publish::Actions& actions) {
  // An undelivered command appends its refusal: walk by index.
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto action = std::move(actions[i]);
    if (const auto* message = std::get_if<publish::PublishText>(&action)) {
      if (broker_) broker_->publish(std::string(message->topic).c_str(), message->text);
    } else if (const auto* answer = std::get_if<publish::Answer>(&action)) {
      const auto waiting = waiting_.find(answer->id.number);
      if (waiting == waiting_.end()) continue;
      json::JsonText reply;
      reply.open('{').key("ok").boolean(answer->ok);
      reply.key(answer->ok ? "note" : "reason").text(answer->text).close('}');
      cli_.reply(waiting->second, reply.take());
      waiting_.erase(waiting);
    } else if (const auto* line = std::get_if<publish::LogLine>(&action)) {
      log(log_level(line->level), line->text);
    } else if (const auto* job = std::get_if<store::StorageJob>(&action)) {
      if (storage_.jobs.push(*job)) {
        storage_.jobs_ready.notify();
      } else {
        service_.on_reply({job->id, false, "the disk is too slow: too many writes wait", {}},
                          monotonic_now(), actions);
      }
    } else if (const auto* command = std::get_if<Command>(&action)) {
      if (!control_.commands.push(*command)) service_.on_undelivered(*command, actions);
    }
  }
  actions.clear();
}

void PublishLoop::on_cli_line(CliServer::ClientId client, std::string_view line, Time now) {
  const auto document =
      json::parse(line, {.max_bytes = 64 * 1024, .max_depth = 4, .max_values = 64});
  if (!document) return cli_.reply(client, refusal("not understood: " + document.error().text()));
  const auto text_of = [&](std::string_view key) {
    const auto* node = document->root.find(key);
    return node != nullptr && node->text() != nullptr ? *node->text() : std::string();
  };
  const auto cmd = text_of("cmd");
  const auto name = text_of("name");
  const auto request = [&](publish::ControlCommand command) {
    const auto number = next_request_++;
    waiting_[number] = client;
    service_.on_cli(number, std::move(command), now, actions_);
    carry_out(actions_);
  };
  if (cmd == "task_start") {
    const auto* id = document->root.find("id");
    const auto* speed = document->root.find("speed");
    if (id == nullptr || !id->integer() || speed == nullptr || !speed->number())
      return cli_.reply(client, refusal("id (a whole number) or speed is missing"));
    return request(publish::StartTaskRequest{name, *id->integer(), *speed->number()});
  }
  if (cmd == "task_cancel") return request(publish::CancelTaskRequest{});
  if (cmd == "traj_delete") return request(publish::DeleteTrajectory{name});
  if (cmd == "reset") return request(publish::ResetStopRequest{});
  cli_.reply(client, cli_reply(cmd, name));
}

/// Questions that are answered from what is at hand.
std::string PublishLoop::cli_reply(std::string_view cmd, const std::string& name) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true);
  if (cmd == "version") {
    out.key("version").text(DROVER_VERSION);
  } else if (cmd == "status") {
    publish::DaemonStatus daemon;
    daemon.robot = config_.robot_name;
    daemon.broker_connected = broker_ && broker_->connected();
    daemon.broker_text = broker_ ? broker_text_ : "not configured";
    daemon.uptime_s = to_s(monotonic_now() - started_);
    daemon.telemetry_dropped = broker_ ? broker_->dropped() : 0;
    daemon.events_lost = control_.lost_events.load(std::memory_order_relaxed);
    // The status is an object of its own already.
    return R"({"ok":true,"status":)" + publish::status_json(control_.snapshot.latest(), daemon) +
           "}";
  } else if (cmd == "traj_list") {
    out.key("tracks").open('[');
    for (const auto& [key, track] : service_.tracks()) {
      out.open('{').key("name").text(key);
      out.key("points").integer(static_cast<std::int64_t>(track.points.size()));
      out.key("length_m").number(length_m(track)).close('}');
    }
    out.close(']');
  } else if (cmd == "traj_show") {
    const auto track = service_.find_track(name);
    if (!track) return refusal("there is no track named \"" + name + "\"");
    const auto list = publish::trajectory_data_text({&*track, 1});
    return R"({"ok":true,"track":)" + list.substr(1, list.size() - 2) + "}";
  } else {
    return refusal("unknown request \"" + std::string(cmd) + "\"");
  }
  out.close('}');
  return out.take();
}

}  // namespace drover::runtime
