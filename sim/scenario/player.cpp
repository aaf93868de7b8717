#include "sim/scenario/player.h"

#include <poll.h>
#include <sched.h>
#include <sys/signalfd.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "sim/robot/log.h"

namespace drover::sim {
namespace {

constexpr const char* kCommandLine = "drover";
constexpr Duration kLook = std::chrono::milliseconds(10);
constexpr Duration kReconnect = std::chrono::milliseconds(50);
// From all is well to the start: a person reads the status first. A robot that has just been
// switched on needs it too: at rest it learns how its gyro drifts.
constexpr Duration kReading = std::chrono::seconds(1);
constexpr Duration kSecond = std::chrono::seconds(1);
// Real time: a loaded machine may take long to load a world.
constexpr Duration kBootTimeout = std::chrono::seconds(60);
constexpr Duration kEndTimeout = std::chrono::seconds(5);

Time now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec)};
}

link::UniqueFd block_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&set, number);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  return link::UniqueFd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

/// Whoever looks on lets the others say what they have to say and takes it all at once: in the lab
/// a change of programs is dear. The children are not concerned.
void run_after_the_others() {
  const sched_param none{};
  (void)::sched_setscheduler(0, SCHED_BATCH | SCHED_RESET_ON_FORK, &none);
}

/// One line whatever it says: control characters as \xNN.
void append_line(std::string& line, std::string_view text) {
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) {
      line += c;
      continue;
    }
    std::array<char, 8> code{};
    std::snprintf(code.data(), code.size(), "\\x%02X", static_cast<unsigned>(c) & 0xFFU);
    line += code.data();
  }
  line += '\n';
}

/// Protobuf packets: every byte as two hex digits.
void append_hex_line(std::string& line, std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (const char c : bytes) {
    line += kDigits[static_cast<unsigned char>(c) >> 4U];
    line += kDigits[static_cast<unsigned char>(c) & 0xFU];
  }
  line += '\n';
}

/// What a program said last is mostly why it ended.
std::string last_line(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return "by signal " + std::to_string(WTERMSIG(status));
  return "with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Player::Player(const Workplace& workplace, const Mission& mission, View& view)
    : workplace_(workplace),
      mission_(mission),
      view_(view),
      events_log_(workplace.log_folder() + "/events.log"),
      mqtt_log_(workplace.log_folder() + "/mqtt.log"),
      signals_(block_signals()),
      children_(workplace.log_folder()),
      story_(mission.steps),
      result_{mission.target_id} {
  run_after_the_others();
}

Outcome Player::play() {
  boot_ = next_second_ = now();
  boot();
  if (going()) happened("boot");
  const Time timeout = boot_ + mission_.timeout;
  while (going() && turn(std::min(end_, timeout))) {
  }
  tell(interrupted_       ? "interrupted"
       : !broken_.empty() ? "broken: " + broken_
       : now() >= end_    ? "the end"
                          : "time-out");
  if (interrupted_) return Outcome::interrupted;
  if (!broken_.empty()) return Outcome::broken;
  if (now() < end_) return Outcome::timed_out;
  return result_.status == mission_.expect_status ? Outcome::as_expected : Outcome::otherwise;
}

void Player::keep_running() {
  while (going()) turn(Time::max());
}

/// The records end first: what follows is no part of the scenario.
bool Player::finish() {
  recording_ = false;
  interrupted_ = false;
  broken_.clear();
  frozen_.reset();
  for (const auto* name : {"drover-sim", "droverd", "drover-guard", "udevd", "mosquitto"})
    end_program(name);
  events_log_.flush();
  mqtt_log_.flush();
  return broken_.empty();
}

void Player::end_program(const std::string& name) {
  killed_.insert(name);
  // One that was stopped by a step hears nothing else.
  if (!children_.signal(name, SIGCONT) || !children_.signal(name, SIGTERM)) return;
  const Time limit = now() + kEndTimeout;
  for (Time t = now(); children_.runs(name) && t < limit; t = now()) poll_once(limit - t);
  if (children_.runs(name)) broken_ = name + " did not end within five seconds";
}

void Player::boot() {
  client_.emplace(workplace_.port(), [this](const MqttMessage& message) { on_message(message); });
  start("mosquitto");
  if (workplace_.has_udev()) {
    start("udevd");
    wait_for("udevd", [] { return std::filesystem::exists("/run/udev/control"); });
  }
  start("drover-sim");
  wait_for("the broker", [this] { return client_->subscribed(); });
  wait_for("drover-sim", [this] { return std::filesystem::exists(workplace_.ready_file()); });
  start("drover-guard");
  wait_for("drover-guard", [this] { return std::filesystem::exists(workplace_.guard_socket()); });
  start("droverd");
}

void Player::wait_for(const std::string& what, const std::function<bool()>& is_there) {
  const Time limit = now() + kBootTimeout;
  while (going() && !is_there()) {
    if (now() > limit) broken_ = what + " did not come up";
    turn(now() + kLook);
  }
}

void Player::start(const std::string& name, const std::vector<std::string>& words) {
  if (!going()) return;
  if (name == kCommandLine && children_.runs(name)) {
    calls_.push_back(words);  // one after the other, as a person types them
    return;
  }
  const auto problem = children_.start(workplace_.program(name, words));
  killed_.erase(name);
  tell("start " + name + (words.empty() ? "" : " " + shown_words(words)) +
       (problem.empty() ? "" : ": " + problem));
  if (!problem.empty()) broken_ = problem;
}

/// Works off what is due and waits for more, until `until` at most, once. False: it is `until`.
bool Player::turn(Time until) {
  const Time t = now();
  if (t >= until) return false;
  take_steps(t);
  command_joints(t);
  tell_journeys(t);
  start_when_ready(t);
  if (t >= next_reconnect_) {
    client_->connect();
    next_reconnect_ = t + kReconnect;
  }
  if (t >= next_second_) {
    client_->serve(false, false);
    events_log_.flush();
    mqtt_log_.flush();
    next_second_ = t + kSecond;
  }
  until = std::min(
      {until, next_second_, story_.next(t), commands_.next(), journeys_.next(), start_at_});
  if (client_->descriptor() < 0) until = std::min(until, next_reconnect_);
  until = std::min(until, view_.draw(t, report_));
  poll_once(until - t);
  return true;
}

void Player::poll_once(Duration wait) {
  std::array<pollfd, 16> polls{};
  std::size_t count = 0;
  const auto watch = [&](int fd, bool writing) {
    if (fd >= 0 && count < polls.size())
      polls[count++] = {fd, static_cast<short>(writing ? POLLIN | POLLOUT : POLLIN), 0};
  };
  watch(client_->descriptor(), client_->wants_to_write());
  watch(signals_.get(), false);
  watch(view_.descriptor(), false);
  for (const int fd : children_.descriptors()) watch(fd, false);
  const auto left = std::max(Duration::zero(), wait);
  const timespec timeout{static_cast<time_t>(left.count() / 1'000'000'000),
                         left.count() % 1'000'000'000};
  if (::ppoll(polls.data(), count, &timeout, nullptr) <= 0) return;
  bool child_ended = false;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& poll = polls[i];
    if (poll.revents == 0) continue;
    if (poll.fd == signals_.get()) {
      signalfd_siginfo info{};
      while (::read(signals_.get(), &info, sizeof info) == sizeof info)
        if (info.ssi_signo != SIGCHLD) interrupted_ = true;
    } else if (poll.fd == client_->descriptor()) {
      client_->serve((poll.revents & ~POLLOUT) != 0, (poll.revents & POLLOUT) != 0);
    } else if (poll.fd == view_.descriptor()) {
      view_.on_readable();
    } else {
      child_ended = true;
    }
  }
  if (client_->subscribed() != was_subscribed_) {
    was_subscribed_ = !was_subscribed_;
    happened(was_subscribed_ ? "broker_back" : "broker_lost");
  }
  if (child_ended) collect_children();
}

void Player::collect_children() {
  for (const auto& ended : children_.reap()) {
    tell("end of " + ended.name + " " + how_it_ended(ended.status));
    const bool asked = killed_.contains(ended.name) || ended.name == kCommandLine;
    // A program that was asked to end, not killed, must do so cleanly.
    const bool clean = WIFSIGNALED(ended.status)
                           ? WTERMSIG(ended.status) == SIGKILL || WTERMSIG(ended.status) == SIGTERM
                           : WEXITSTATUS(ended.status) == 0 || ended.name == kCommandLine;
    if (!asked || !clean) {
      broken_ = ended.name + " ended " + how_it_ended(ended.status);
      const auto said = last_line(workplace_.log_folder() + "/" + ended.name + ".log");
      if (!said.empty()) broken_ += ": " + workplace_.as_written(said);
    }
    if (asked) happened("exit_" + ended.name);
    if (ended.name == kCommandLine && !calls_.empty()) {
      const auto words = std::move(calls_.front());
      calls_.pop_front();
      start(kCommandLine, words);
    }
  }
}

void Player::on_message(const MqttMessage& message) {
  const Time t = now();
  if (!recording_) return;
  std::string line;
  append_stamp(line, t);
  line += message.topic;
  line += message.retained ? " 1 " : " 0 ";
  if (message.topic.starts_with("/channel/")) {
    append_hex_line(line, message.payload);
  } else {
    append_line(line, message.payload);
  }
  mqtt_log_.append(line);
  if (message.retained) return;
  std::vector<std::string> events;
  if (message.topic == "base_status") {
    events = report_.on_base_status(message.payload);
    if (const auto words = waits_.look(t, report_); !words.empty()) tell(words);
  }
  if (message.topic == "feedback") events = report_.on_feedback(message.payload);
  if (message.topic == "scene_feedback") events = report_.on_scene_feedback(message.payload);
  for (const auto& event : events) happened(event);
}

void Player::happened(const std::string& event) {
  const Time t = now();
  const auto count = story_.happened(event, t);
  tell("event " + event + "#" + std::to_string(count));
  result_.happened(event, report_.nav_status(), t);
  if (mission_.automatic && event == "ready" && count == 1) save_track();
  if (mission_.automatic && (event == "saved" || event == "ready")) look_whether_ready();
  look_for_end(event);
}

/// As an operator does: with the track saved and the robot sure of its place.
void Player::look_whether_ready() {
  if (started_ || !story_.has_happened({"saved", 1}) || report_.locate() != "LOCATE_TRUE") return;
  if (start_at_ == Time::max()) start_at_ = now() + kReading;
}

void Player::start_when_ready(Time t) {
  if (t < start_at_) return;
  start_at_ = Time::max();
  // Not sure any more: the next "ready" begins anew.
  if (started_ || report_.locate() != "LOCATE_TRUE") return;
  started_ = true;
  start_task({});
}

void Player::look_for_end(const std::string& event) {
  if (end_ != Time::max()) return;
  const bool end = mission_.end_after ? story_.has_happened(*mission_.end_after)
                                      : event == "nav_success" || event == "nav_error" ||
                                            event == "start_task_failed" ||
                                            event == "start_nav_failed" || event == "save_failed";
  if (end) end_ = now() + mission_.end_delay;
}

void Player::tell(const std::string& text) {
  std::string line;
  append_stamp(line, now());
  append_line(line, text);
  events_log_.append(line);
  if (recording_) view_.on_event(text);
}

}  // namespace drover::sim
