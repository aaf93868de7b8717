#include "runtime/daemon.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <systemd/sd-daemon.h>

#include <cerrno>
#include <stdexcept>
#include <thread>

#include "link/opened.h"
#include "runtime/battery_loop.h"
#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "runtime/log.h"
#include "runtime/publish_loop.h"
#include "runtime/realtime.h"
#include "runtime/storage_loop.h"
#include "store/posix_files.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// One daemon on a robot: two would fight over the drives.
link::UniqueFd take_lock(const std::string& folder) {
  ::mkdir(folder.c_str(), 0755);
  const auto path = folder + "/droverd.lock";
  link::UniqueFd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!fd) throw std::runtime_error(link::problem_text(path, "cannot open", errno));
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

class Daemon final {
 public:
  explicit Daemon(const config::DroverConfig& config)
      : config_(config),
        files_(),
        storage_(files_, config.paths.state),
        gateway_(config),
        keeper_(config, guard_, stop_frames()),
        battery_(config.battery.configured
                     ? std::make_unique<BatteryLoop>(config.battery, battery_exchange_)
                     : nullptr),
        control_(config, gateway_, keeper_, guard_, control_exchange_,
                 battery_ ? &battery_exchange_ : nullptr),
        publish_(config, control_exchange_, storage_exchange_, storage_.load()) {}

  void run() {
    std::thread keeper([this] { keeper_.run(stop_keeper_); });
    std::thread storage([this] { run_storage(storage_, storage_exchange_, stop_publish_); });
    std::thread battery;
    if (battery_) battery = std::thread([this] { battery_->run(stop_battery_); });
    std::thread control([this] {
      if (config_.control.realtime)
        if (const auto missing = become_real_time(config_.control.priority); !missing.empty())
          log(LogLevel::warning, missing);
      control_.run(stop_control_);
    });
    std::thread publish([this] { publish_.run(stop_publish_); });
    ::sd_notify(0, "READY=1");
    log(LogLevel::info, "droverd " DROVER_VERSION " runs");
    for (const auto& caution : gateway_.cautions()) log(LogLevel::warning, caution);
    wait_for_end();
    ::sd_notify(0, "STOPPING=1");
    come_to_rest();
    stop_battery_ = true;
    if (battery_) battery_->wake();
    stop_publish_ = true;
    publish_.wake();
    storage_exchange_.jobs_ready.notify();
    publish.join();
    storage.join();
    // Until here the guard saw our heartbeat; from here on it keeps the drives at rest by itself.
    stop_control_ = true;
    control.join();
    if (battery.joinable()) battery.join();
    stop_keeper_ = true;
    keeper_.wake();
    keeper.join();
  }

 private:
  std::vector<std::vector<CanFrame>> stop_frames() const {
    std::vector<std::vector<CanFrame>> frames;
    for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus)
      frames.push_back(gateway_.stop_frames(bus));
    return frames;
  }

  /// Waits for a signal, and tells systemd each half second that all threads live.
  void wait_for_end() {
    const auto signals = end_signals();
    std::uint64_t beats = 0;
    std::uint64_t turns = 0;
    std::uint64_t battery_turns = 0;
    int battery_still = 0;
    for (;;) {
      const timespec half_second{0, 500'000'000};
      if (::sigtimedwait(&signals, nullptr, &half_second) > 0) return;
      const auto new_beats = control_exchange_.beats.load(std::memory_order_relaxed);
      const auto new_turns = publish_.turns();
      // The battery's thread may take its time, but not for ever.
      const auto new_battery = battery_ ? battery_->turns() : 0;
      battery_still = battery_ && new_battery == battery_turns ? battery_still + 1 : 0;
      battery_turns = new_battery;
      const bool battery_lives = battery_still * 500ms < BatteryLoop::kLongestTurn;
      if (new_beats != beats && new_turns != turns && battery_lives) ::sd_notify(0, "WATCHDOG=1");
      beats = new_beats;
      turns = new_turns;
    }
  }

  /// A controlled stop: as the operator's cancel, with at most two seconds.
  void come_to_rest() {
    publish_.request_cancel();
    for (int i = 0; i < 40 && !control_exchange_.at_rest.load(std::memory_order_relaxed); ++i)
      std::this_thread::sleep_for(50ms);
  }

  const config::DroverConfig& config_;
  store::PosixFiles files_;
  store::Storage storage_;
  Gateway gateway_;
  GuardMemory guard_;
  LinkKeeper keeper_;
  ControlExchange control_exchange_;
  StorageExchange storage_exchange_;
  BatteryExchange battery_exchange_;
  std::unique_ptr<BatteryLoop> battery_;
  ControlLoop control_;
  PublishLoop publish_;
  std::atomic<bool> stop_control_{false};
  std::atomic<bool> stop_publish_{false};
  std::atomic<bool> stop_battery_{false};
  std::atomic<bool> stop_keeper_{false};
};

}  // namespace

int run_daemon(const config::DroverConfig& config) {
  const auto lock = take_lock(config.paths.run);
  const auto signals = end_signals();
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before any thread, so that all inherit it
  ::signal(SIGPIPE, SIG_IGN);
  const auto daemon = std::make_unique<Daemon>(config);
  daemon->run();
  log(LogLevel::info, "droverd ends; the robot is at rest");
  return 0;
}

}  // namespace drover::runtime
