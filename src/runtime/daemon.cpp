#include "runtime/daemon.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <span>
#include <stdexcept>
#include <thread>

#include "link/opened.h"
#include "runtime/battery_loop.h"
#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "runtime/farewell.h"
#include "runtime/learned_subject.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"
#include "runtime/realtime.h"
#include "runtime/scan_loop.h"
#include "runtime/scene_loop.h"
#include "runtime/serial_loop.h"
#include "runtime/stop_listener.h"
#include "runtime/storage_loop.h"
#include "runtime/supervisor.h"
#include "runtime/systemd_notify.h"
#include "runtime/worker.h"
#include "store/posix_files.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// One daemon on a robot: two would fight over the drives.
link::UniqueFd take_lock(const std::string& folder) {
  if (::mkdir(folder.c_str(), 0755) != 0 && errno != EEXIST)
    throw std::runtime_error(
        link::problem_text("paths.run: " + folder, "cannot make this folder", errno) +
        " (systemd-tmpfiles --create drover.conf makes /run/drover)");
  const auto path = folder + "/droverd.lock";
  link::UniqueFd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!fd)
    throw std::runtime_error(link::problem_text(path, "cannot open", errno) +
                             " (paths.run has to be a folder that droverd may write in; "
                             "systemd-tmpfiles --create drover.conf makes /run/drover)");
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) {
    char pid[16] = {};
    (void)!::pread(fd.get(), pid, sizeof pid - 1, 0);
    throw std::runtime_error("droverd runs already, pid " + std::string(pid));
  }
  const auto pid = std::to_string(::getpid());
  if (::ftruncate(fd.get(), 0) != 0 ||
      ::pwrite(fd.get(), pid.data(), pid.size(), 0) != static_cast<ssize_t>(pid.size()))
    throw std::runtime_error(link::problem_text(path, "cannot write", errno));
  return fd;
}

sigset_t end_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGTERM);
  ::sigaddset(&signals, SIGINT);
  return signals;
}

constexpr Duration kFeedEach = 200ms;  // of systemd's watchdog, which has 1 s
/// For the stop at the end: longer than a base on a slope is given to begin again after a dip of
/// its supply.
constexpr Duration kLongestEnd = 3500ms;
static_assert(kLongestEnd > ProgramWatch::kLongestStop);

class Daemon final {
 public:
  Daemon(const config::Loaded& loaded, const std::string& record)
      : Daemon(loaded.config, publish::ConfigurationTexts{loaded.text, loaded.register_map}) {
    if (record.empty()) return;
    recorder_ = std::make_unique<Recorder>(
        record, gateway::RecordingHeader{DROVER_VERSION, loaded.text, loaded.register_map,
                                         gateway::mathematics_fingerprint(),
                                         gateway::field_names(gateway_)});
    control_exchange_.recorder = recorder_.get();
  }
  Daemon(const config::DroverConfig& config, const publish::ConfigurationTexts& texts)
      : config_(config),
        files_(),
        storage_(files_, config.paths.state, config.paths.run),
        gateway_(config),
        keeper_(config, gateway_.wiring(), guard_, gateway_.duties()),
        serial_(gateway_.wiring()),
        slow_(slow_links(config, gateway_.wiring())),
        scanners_(scan_links(config)),
        stored_(storage_.load(scene_age(config.scene))),
        learned_(of_this_robot(config, stored_)),
        memory_(config.paths.run, boot_id(), texts.configuration, stored_.report),
        on_disk_(stored_.stop),
        control_(config, gateway_, keeper_, serial_, guard_, control_exchange_,
                 {memory_, storage_exchange_}, slow_),
        parser_(publish::ControlLimits{}),
        scene_(config.scene.configured ? std::make_unique<Scene>(config, stored_, scanners_)
                                       : nullptr),
        stop_listener_(config.mqtt.enabled
                           ? std::make_unique<StopListener>(config.mqtt, control_exchange_.stops)
                           : nullptr),
        publish_(config, control_exchange_, storage_exchange_, parser_, scene_partners(),
                 stop_listener_.get(), std::move(stored_), learned_, texts, scanners_) {
    if (scene_) control_exchange_.scene = &scene_->exchange.sight;
  }

  void run() {
    control_.recall(recall(memory_, on_disk_));
    if (learned_) {
      control_.recall(learned_->values);
      log(LogLevel::info, "what the robot has learned of itself is used: drover learned show");
    }
    Threads threads;
    begin(threads);
    ready_told_ = systemd_.tell("READY=1");
    log(LogLevel::info, "droverd " DROVER_VERSION " runs");
    for (const auto& caution : gateway_.cautions()) log(LogLevel::warning, caution);
    watch_threads();
    wait_for_end();
    (void)systemd_.tell("STOPPING=1");
    come_to_rest();
    end(threads);
  }

 private:
  /// Threads and what they share with the others.
  struct Scene {
    Scene(const config::DroverConfig& config, const store::StoredState& all,
          std::span<const std::unique_ptr<ScanLink>> scanners)
        : stored(all.scene), loop(config, exchange, stored, scanners) {}
    std::shared_ptr<const store::StoredScene> stored;
    SceneExchange exchange;
    SceneParserLoop parser;
    SceneLoop loop;
  };

  struct Threads {
    std::optional<Worker> keeper, storage, parser, serial, control, publish;
    std::vector<std::unique_ptr<Worker>> batteries, scanners;
    std::optional<Worker> recorder;             ///< none: nothing is recorded
    std::optional<Worker> scene, scene_parser;  ///< none: the robot has no scene
    std::optional<Worker> stops;                ///< none: without a broker
  };

  /// Whoever is asked begins before who asks.
  void begin(Threads& of) {
    of.keeper.emplace("links", [this] { keeper_.run(stop_keeper_); });
    of.storage.emplace(
        "storage", [this] { run_storage(storage_, storage_exchange_, on_disk_, stop_publish_); });
    for (const auto& link : slow_)
      of.batteries.push_back(std::make_unique<Worker>(
          "battery", [this, loop = link->loop.get()] { loop->run(stop_battery_); }));
    for (const auto& scanner : scanners_)
      of.scanners.push_back(std::make_unique<Worker>(
          "scanner", [this, loop = scanner->loop.get()] { loop->run(stop_scanners_); }));
    if (recorder_) {
      log(LogLevel::info, "records to " + recorder_->file());
      of.recorder.emplace("recorder", [this] { recorder_->run(stop_recorder_); });
    }
    of.parser.emplace("parser", [this] { parser_.run(stop_publish_); });
    if (scene_) {
      of.scene.emplace("scene", [this] { scene_->loop.run(stop_publish_); });
      of.scene_parser.emplace("scene parser", [this] { scene_->parser.run(stop_publish_); });
    }
    of.serial.emplace("serial", [this] { run_serial(); });
    of.control.emplace("control", [this] { run_control(); });
    of.publish.emplace("publish", [this] { publish_.run(stop_publish_); });
    if (stop_listener_) of.stops.emplace("stops", [this] { stop_listener_->run(stop_publish_); });
  }

  /// Nobody commands any more, then nobody steers; the way to the drives goes last.
  void end(Threads& of) {
    stop_battery_ = true;
    for (const auto& link : slow_) link->loop->wake();
    stop_scanners_ = true;
    for (const auto& scanner : scanners_) scanner->loop->wake();
    stop_publish_ = true;
    publish_.wake();
    storage_exchange_.jobs_ready.notify();
    parser_.wake();
    if (stop_listener_) stop_listener_->wake();
    if (scene_) scene_->parser.wake();
    join(*of.publish, 1s);
    if (of.stops) join(*of.stops, 1s);
    join(*of.storage, 1s);
    join(*of.parser, 1s);
    if (of.scene) join(*of.scene, 1s);
    if (of.scene_parser) join(*of.scene_parser, 1s);
    // From here on the guard sees no heartbeat, if it still does: it keeps the drives at rest.
    stop_control_ = true;
    join(*of.control, 1s);
    for (const auto& battery : of.batteries) join(*battery, BatteryLoop::kLongestTurn);
    for (const auto& scanner : of.scanners) join(*scanner, ScanLoop::kLongestTurn);
    stop_recorder_ = true;
    if (recorder_) recorder_->wake();
    if (of.recorder) join(*of.recorder, 1s);
    // A line that lets nobody go ends the daemon here: the recording has its end already.
    stop_serial_ = true;
    serial_.wake();
    join(*of.serial, 1s);
    stop_keeper_ = true;
    keeper_.wake();
    join(*of.keeper, 1s);
  }

  static std::optional<store::SceneAge> scene_age(const config::SceneConfig& scene) {
    if (!scene.configured) return std::nullopt;
    const Duration wall = monotonic_now().time_since_epoch() + wall_minus_monotonic();
    store::SceneAge age{to_s(wall)};
    if (scene.max_object_age_s > 0) age.max_age_s = scene.max_object_age_s;
    return age;
  }
  std::optional<ScenePartners> scene_partners() {
    if (!scene_) return std::nullopt;
    return ScenePartners{scene_->exchange, scene_->parser, scene_->stored};
  }

  /// What was learned beside another configuration is none of its errors.
  static std::optional<store::KeptLearned> of_this_robot(const config::DroverConfig& config,
                                                         store::StoredState& stored) {
    if (!stored.learned || !knows_any(stored.learned->values)) return std::nullopt;
    if (stored.learned->subject == learned_subject(config)) return stored.learned;
    stored.report.emplace_back(
        "base, drives, antennas or sensors are configured otherwise than when the robot learned of "
        "itself: it learns anew");
    return std::nullopt;
  }

  void run_control() {
    if (config_.control.realtime)
      if (const auto missing = become_real_time(config_.control.priority); !missing.empty())
        log(LogLevel::warning, missing);
    control_.run(stop_control_);
  }

  /// What it waits with keeps the control thread waiting. Whether it may come first, that one says.
  void run_serial() {
    if (config_.control.realtime) (void)become_real_time(config_.control.priority);
    serial_.run(stop_serial_);
  }

  /// Each with its own limit. Of what persons say, the publish thread hears most: the robot is to
  /// stop within a second of its last turn.
  void watch_threads() {
    supervisor_.watch({"droverd's control thread stands still", &control_exchange_.beats, 1s});
    supervisor_.watch({"droverd's publish thread stands still", &publish_.turns(), 600ms});
    supervisor_.watch(
        {"droverd's parser thread stands still", &parser_.turns(), ParserLoop::kLongestTurn});
    if (stop_listener_)
      supervisor_.watch(
          {"droverd's thread for stops stands still", &stop_listener_->turns(), 600ms});
    if (scene_) {
      supervisor_.watch(
          {"droverd's scene thread stands still", &scene_->loop.turns(), SceneLoop::kLongestTurn});
      supervisor_.watch({"droverd's parser thread of the scene stands still",
                         &scene_->parser.turns(), SceneParserLoop::kLongestTurn});
    }
    supervisor_.watch({"droverd's link thread stands still", &keeper_.turns(), 5s});
    supervisor_.watch(
        {"droverd's serial thread stands still", &serial_.turns(), SerialLoop::kLongestTurn});
    for (const auto& link : slow_)
      supervisor_.watch({"droverd's battery thread stands still", &link->loop->turns(),
                         BatteryLoop::kLongestTurn});
    for (const auto& scanner : scanners_)
      supervisor_.watch({"droverd's scanner thread stands still", &scanner->loop->turns(),
                         ScanLoop::kLongestTurn});
  }

  /// Waits for a signal, and looks ten times a second whether all threads live.
  void wait_for_end() {
    const auto signals = end_signals();
    const timespec period{0, Supervisor::kPeriod.count()};
    while (::sigtimedwait(&signals, nullptr, &period) <= 0) look_at_threads(monotonic_now());
  }

  void look_at_threads(Time now) {
    control_exchange_.looks.fetch_add(1, std::memory_order_relaxed);
    const auto* stalled = supervisor_.stalled(now);
    if (stalled != stalled_) {
      stalled_ = stalled;
      stalled_since_ = now;
      control_exchange_.trouble.store(stalled == nullptr ? nullptr : stalled->trouble,
                                      std::memory_order_release);
      if (stalled != nullptr)
        log(LogLevel::error, std::string(stalled->trouble) + ": the robot stops");
    }
    if (!ready_told_) ready_told_ = systemd_.tell("READY=1");
    // Ending us now would cut the orderly stop short, for which the control thread still lives.
    const bool stopping = !control_exchange_.at_rest.load(std::memory_order_relaxed) &&
                          now - stalled_since_ < ProgramWatch::kLongestStop;
    if (now < next_feed_ || (stalled_ != nullptr && !stopping)) return;
    next_feed_ = now + kFeedEach;
    (void)systemd_.tell("WATCHDOG=1");
  }

  /// A controlled stop, as the operator's cancel.
  void come_to_rest() {
    constexpr Duration kLook = 50ms;
    control_exchange_.stops.ask_cancel();
    control_exchange_.trouble.store("droverd ends", std::memory_order_release);
    for (const std::string& sinks : what_sinks(config_.engine)) log(LogLevel::warning, sinks);
    for (Duration waited{}; waited < kLongestEnd; waited += kLook) {
      control_exchange_.looks.fetch_add(1, std::memory_order_relaxed);
      std::this_thread::sleep_for(kLook);  // the first one lets the control thread hear of it
      if (rests()) return log(LogLevel::info, "the robot is at rest");
    }
    log(LogLevel::error, "the robot is not at rest: the guard goes on stopping it");
  }

  /// A thread that does not end must not keep the daemon from it: the guard has the drives, and
  /// what was acknowledged is on the disk.
  static void join(Worker& worker, Duration longest) {
    if (worker.join_within(longest)) return;
    log(LogLevel::error,
        std::string("the thread ") + worker.name() + " does not end; ended without");
    std::this_thread::sleep_for(50ms);  // for the log
    ::_exit(0);
  }
  bool rests() const { return control_exchange_.at_rest.load(std::memory_order_relaxed); }

  const config::DroverConfig& config_;
  store::PosixFiles files_;
  store::Storage storage_;
  Gateway gateway_;
  GuardMemory guard_;
  LinkKeeper keeper_;
  SerialLoop serial_;
  ControlExchange control_exchange_;
  StorageExchange storage_exchange_;
  const std::vector<std::unique_ptr<SlowLink>> slow_;  ///< Modbus lines
  const std::vector<std::unique_ptr<ScanLink>> scanners_;
  std::unique_ptr<Recorder> recorder_;               ///< nullptr: nothing is recorded
  store::StoredState stored_;                        ///< given on to the publish thread
  const std::optional<store::KeptLearned> learned_;  ///< of this configuration
  RobotMemory memory_;
  const Remembered on_disk_;
  ControlLoop control_;
  ParserLoop parser_;
  std::unique_ptr<Scene> scene_;                 ///< nullptr: the robot has none
  std::unique_ptr<StopListener> stop_listener_;  ///< nullptr: without a broker
  PublishLoop publish_;
  Supervisor supervisor_;
  SystemdNotify systemd_;
  bool ready_told_ = false;
  const WatchedThread* stalled_ = nullptr;
  Time stalled_since_ = kNever;
  Time next_feed_ = kNever;
  std::atomic<bool> stop_control_{false};
  std::atomic<bool> stop_publish_{false};
  std::atomic<bool> stop_serial_{false};
  std::atomic<bool> stop_battery_{false};
  std::atomic<bool> stop_scanners_{false};
  std::atomic<bool> stop_keeper_{false};
  std::atomic<bool> stop_recorder_{false};
};

}  // namespace

int run_daemon(const config::Loaded& loaded, const std::string& file, const std::string& record) {
  const auto lock = take_lock(loaded.config.paths.run);
  const auto signals = end_signals();
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before any thread, so that all inherit it
  ::signal(SIGPIPE, SIG_IGN);
  const LogWriter log_writer;  // before any other thread: nobody waits for standard error
  for (const auto& warning : loaded.warnings) log(LogLevel::warning, warning.text(file));
  const auto daemon = std::make_unique<Daemon>(loaded, record);
  daemon->run();
  log(LogLevel::info, "droverd ends");
  return 0;
}

}  // namespace drover::runtime
