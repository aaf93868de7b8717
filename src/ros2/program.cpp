#include "ros2/program.h"

#include <poll.h>

#include <array>
#include <random>

#include "json/json_text.h"
#include "json/located_json.h"
#include "link/packet_question.h"
#include "ros2/networks.h"
#include "ros2/say.h"
#include "runtime/clock.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;

constexpr Duration kBeat = 1s;
/// droverd sends at least once a second.
constexpr Duration kSilent = 1500ms;
/// Of who ends, with droverd and with drover-guard.
constexpr std::chrono::milliseconds kPatience = 300ms;

Stamp_ns wall_now_ns() {
  return (runtime::monotonic_now().time_since_epoch() + runtime::wall_minus_monotonic()).count();
}

/// As drover-guard has it, unless it is told otherwise.
std::string beside(const std::string& path, const char* name) {
  return path.substr(0, path.rfind('/') + 1) + name;
}

bool guard_takes_stop(const std::string& path) {
  const auto answer = link::ask_packet(path, "stop", kPatience);
  if (!answer) return false;
  const auto state = json::parse(*answer);
  const auto* latched = state ? state->root.find("latched") : nullptr;
  return latched != nullptr && latched->boolean() != nullptr && *latched->boolean();
}

/// Nobody can guess it: stops of that name that were done are not done again.
std::string random_name() {
  std::random_device random;
  return std::to_string(random()) + "-" + std::to_string(random()) + "-" + std::to_string(random());
}

}  // namespace

Program::Program(const config::DroverConfig& config)
    : config_(config),
      reach_(config.ros2.mode == "network" ? Reach::network : Reach::localhost),
      robot_(robot_of(config)),
      link_(config.paths.run + "/drover.sock"),
      stop_socket_(beside(config.guard.socket, "stop.sock")),
      asked_(random_name()) {
  take_over_dds_log();
}

void Program::run(const std::atomic<bool>& stop) {
  while (!stop.load(std::memory_order_relaxed)) {
    const Time now = runtime::monotonic_now();
    if (!link_.connected()) way_lost();
    if (now >= next_beat_) {
      next_beat_ = now + kBeat;
      beat(now);
    }
    const Time next = std::min(next_beat_, asked_.due().value_or(next_beat_));
    const auto left = std::max(std::chrono::ceil<std::chrono::milliseconds>(next - now), 0ms);
    // A descriptor of -1 is passed over.
    const short link_events = scene_.waits() && follows_ ? POLLIN | POLLOUT : POLLIN;
    std::array<pollfd, 2> ready{
        {{link_.fd(), link_events, 0}, {users_ ? users_->fd() : -1, POLLIN, 0}}};
    const int count = ::poll(ready.data(), ready.size(), static_cast<int>(left.count()));
    // Who hung says first that it is there: what a stranger hands on is not looked at.
    if (runtime::monotonic_now() >= next_beat_) continue;
    if (count > 0 && ready[1].revents != 0) hear_users(runtime::monotonic_now());
    tell_asked(runtime::monotonic_now());
    if (count <= 0) continue;
    if (ready[0].revents != 0 && link_.connected())
      link_.hear([this](std::string_view line) { take(line); });
    if ((ready[0].revents & POLLOUT) != 0 && follows_ && link_.connected())
      scene_.send([this](const std::string& line) { return link_.send(line); });
  }
  hand_over_stop();
}

/// A stop that came before the end goes on: to droverd, or past one that hangs or is away to
/// drover-guard, which keeps it for the next one. Who restarts a droverd that hangs ends this
/// first.
void Program::hand_over_stop() {
  asked_.hurry();
  const Time now = runtime::monotonic_now();
  if (users_) hear_users(now);
  tell_asked(now);
  while (asked_.stop_is_open() && link_.connected()) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(now + kPatience - runtime::monotonic_now());
    pollfd ready{link_.fd(), POLLIN, 0};
    if (left <= 0ms || ::poll(&ready, 1, static_cast<int>(left.count())) == 0) break;
    link_.hear([this](std::string_view line) { take(line); });
  }
  if (!asked_.stop_is_open()) return;
  if (guard_takes_stop(stop_socket_))
    return say(Level::warning,
               "droverd has not answered an emergency stop: drover-guard has taken it");
  say(Level::error,
      "an emergency stop is lost: neither droverd nor drover-guard has taken it; "
      "press the emergency stop");
}

void Program::beat(Time now) {
  keep_domain(now);
  connect(now);
  tell_users();
  tell_droverd();
  scene_.beat(scene_passed_over_);
}

void Program::connect(Time now) {
  if (link_.connected()) return;
  way_lost();
  link_.keep(now);
  if (link_.connected()) connected_ = now;
}

void Program::way_lost() {
  link_.hear([this](std::string_view line) { take(line); });  // what it said before it went
  follows_ = false;
  scene_.way_lost();
  if (!asked_.way_lost()) return;
  say(Level::warning,
      "droverd was gone before it had answered an emergency stop: it is told again");
}

/// In localhost it is the one whose address programs on this computer use.
std::optional<Network> Program::choose(const std::vector<Network>& there) const {
  return chosen(there, reach_ == Reach::network ? config_.ros2.interface : "", network_);
}

/// Another network is another domain: interfaces are chosen when it is made.
void Program::keep_domain(Time now) {
  auto there = networks();
  if (domain_ && networks_.changed(there)) networks_changed(there, now);
  if (domain_ || !retry_.due(now)) return;
  network_ = choose(there);
  networks_.use(std::move(there));
  make_domain(now);
}

void Program::networks_changed(const std::vector<Network>& there, Time now) {
  say(Level::info, "the networks have changed: " + joined(there));
  networks_.use(there);
  if (choose(there) == network_) return say_unused();
  if (users_) hear_users(now);  // a stop that came
  forget_domain();
  retry_.try_now();
}

void Program::make_domain(Time now) {
  try {
    domain_ = std::make_unique<Domain>(config_.ros2.domain, reach_, network_);
    shown_ = std::make_unique<Shown>(domain_->participant(), robot_, wall_now_ns());
    users_ = std::make_unique<Heard>(domain_->participant(), config_, reach_, scene_passed_over_);
    readers_ = {};
    problem_.clear();
    retry_.succeeded();
    say_who_sees();
    say_who_may();
  } catch (const NoDomain& error) {
    lose_domain(error.what(), now);
  }
}

void Program::lose_domain(const std::string& why, Time now) {
  forget_domain();
  retry_.tried(now);
  if (problem_ != why) say(Level::error, why);
  problem_ = why;
}

void Program::say_who_sees() const {
  const std::string domain = "domain " + std::to_string(config_.ros2.domain) + ": ";
  const std::string here = "programs on this computer see this robot";
  if (reach_ == Reach::localhost) return say(Level::info, domain + here);
  const auto& wanted = config_.ros2.interface;
  if (network_)
    say(Level::info, domain + "whoever reaches " + joined({*network_}) +
                         " sees this robot, and so do programs on this computer");
  else if (wanted.empty())
    say(Level::info, domain + "no network is there yet: " + here);
  else
    say(Level::warning,
        domain + "the network of ros2.interface, " + wanted + ", is not there yet: " + here);
  say_unused();
}

/// Where nobody sees this robot, though it is shown to a network.
std::vector<Network> Program::unused() const {
  if (reach_ == Reach::localhost) return {};
  auto others = networks_.used();
  std::erase(others, network_.value_or(Network{}));
  return others;
}

void Program::say_unused() const {
  const auto others = unused();
  if (!others.empty())
    say(config_.ros2.interface.empty() ? Level::warning : Level::info,
        "not used: " + joined(others) +
            ": nobody there sees this robot or stops it; ros2.interface says which one is used");
}

void Program::say_who_may() const {
  const auto& inputs = config_.ros2.inputs;
  if (!inputs.any()) return;
  const bool open = reach_ == Reach::network && network_;
  const std::string who = open ? "whoever reaches this network" : "programs on this computer";
  const Level level = open ? Level::warning : Level::info;
  if (inputs.may_move() || inputs.e_stop) {
    const std::string what = !inputs.may_move() ? "stop" : inputs.e_stop ? "move and stop" : "move";
    say(level, who + " may " + what + " this robot");
  }
  if (inputs.may_change_scene())
    say(level, who + " may put things around this robot, and take them away");
}

void Program::forget_domain() {
  asked_.forget_twists();
  users_.reset();
  shown_.reset();
  domain_.reset();
}

void Program::hear_users(Time now) {
  try {
    if (users_->stop_asked()) {
      asked_.stop();
      tell_asked(now);  // before anything else: objects take their time
    }
    const Duration wall = now.time_since_epoch() + runtime::wall_minus_monotonic();
    asked_.hear(users_->twists(now, wall));
    users_->joint_commands(now, wall, [this](const std::string& line) { (void)link_.send(line); });
    users_->scene_messages(now, wall, [this](std::string line) { scene_.give(std::move(line)); });
  } catch (const NoDomain& error) {
    lose_domain(error.what(), now);
  }
}

void Program::tell_asked(Time now) {
  if (asked_.due().value_or(now + kBeat) > now) return;
  const bool stop = asked_.stop_is_due(now);
  if (stop) {
    link_.hurry();
    connect(now);
  }
  asked_.tell(now, [this](const std::string& line) { return link_.send(line); });
  if (!stop) return;
  const bool waits = asked_.stop_waits();
  if (waits == stop_waited_ && stopped_ != kNever && now - stopped_ <= kBeat) return;
  say(Level::warning, waits ? "an emergency stop was asked for on /e_stop, and droverd is away: it "
                              "is told as soon as it is back"
                            : "an emergency stop was asked for on /e_stop");
  stopped_ = now;
  stop_waited_ = waits;
}

void Program::stop_refused(const std::string& why) {
  asked_.stop_refused();
  const Time now = runtime::monotonic_now();
  if (refusal_said_ != kNever && now - refusal_said_ <= kBeat) return;
  refusal_said_ = now;
  say(Level::error, "droverd has not done an emergency stop, which is told again: " + why);
}

void Program::take(std::string_view line) {
  if (scene_.answered(line, runtime::monotonic_now())) return;
  const auto told = read_told(line);
  if (!told) {
    if (told.error().done) asked_.answered();
    if (told.error().stop_refused) return stop_refused(told.error().reason);
    if (!told.error().reason.empty()) {
      refusal_ = told.error().reason;
      follows_ = false;
    }
    return;
  }
  refusal_.clear();
  follows_ = true;
  heard_ = runtime::monotonic_now();
  if (!shown_) return;
  shown_->show(*told);
  if (told->diagnostics.empty()) return;
  auto all = told->diagnostics;
  DiagnosticTold own{
      "drover-ros2",
      readers_.unmet.count > 0 ? 1 : 0,
      readers_.unmet.count > 0 ? "some programs want another quality of service" : "all is well",
      {{"readers", std::to_string(readers_.matched)},
       {"incompatible", std::to_string(readers_.unmet.count)},
       {"not_sent", std::to_string(shown_->failed())},
       {"scene_messages_lost", std::to_string(scene_.lost())},
       {"stops_refused", std::to_string(asked_.stops_refused())}}};
  all.push_back(std::move(own));
  shown_->show_diagnostics(told->at_ns, all);
}

/// Without droverd nobody else would tell.
void Program::tell_users() {
  if (shown_) {
    readers_ = shown_->readers();
    if (users_) users_->add_unmet(readers_.unmet);
    for (const auto& news : readers_.unmet.news) say(Level::warning, news);
  }
  const Time now = runtime::monotonic_now();
  const bool hears = heard_ != kNever && now - heard_ < kSilent;
  // It has only just been asked.
  if (!hears && refusal_.empty() && link_.connected() && now - connected_ < kSilent) return;
  const std::string problem = !link_.connected()  ? link_.problem()
                              : !refusal_.empty() ? refusal_
                              : !hears            ? "droverd tells nothing"
                                                  : "";
  if (problem != said_)
    say(problem.empty() ? Level::info : Level::warning,
        problem.empty() ? "droverd tells of the robot" : problem);
  said_ = problem;
  if (problem.empty() || !shown_) return;
  const std::vector<DiagnosticTold> told{{"robot", 2, "not known: " + problem, {}}};
  shown_->show_diagnostics(wall_now_ns(), told);
}

void Program::tell_droverd() {
  json::JsonText line;
  line.open('{').key("cmd").text("ros2_follow").key("mode").text(config_.ros2.mode);
  // The domain's own: of a domain that could not be made no network is in use.
  const bool open = domain_ && reach_ == Reach::network;
  line.key("network").text(open && network_ ? joined({*network_}) : "");
  const auto others = unused();
  line.key("unused").text(open && !others.empty() ? joined(others) : "");
  line.key("reason").text(problem_).key("readers").integer(readers_.matched);
  line.key("incompatible").integer(readers_.unmet.count).close('}');
  (void)link_.send(line.take());  // the next beat says it again
}

}  // namespace drover::ros2
