// A SocketCAN interface. Its frames carry the kernel's stamps.
#include "link/can_open.h"
#include "sim/robot/can_port.h"

namespace drover::sim {
namespace {

constexpr Duration kLate = std::chrono::milliseconds(5);
constexpr Duration kRetry = std::chrono::milliseconds(100);
// The robot's devices answer in bursts, and a queue that is too short would be the test's fault.
constexpr std::size_t kFramesPerTick = 400;

class SocketCanPort final : public CanPort {
 public:
  explicit SocketCanPort(std::string interface)
      : settings_{std::move(interface), kFramesPerTick, false} {}

  void receive(const link::StampWindow& window, std::vector<link::ReceivedFrame>& out) override {
    if (!ready(window.now)) return;
    // In real time the tick is worked off a little after its time; stamps until then are good.
    auto wide = window;
    wide.now += kLate;
    do {
      if (!link_->receive(wide, batch_)) {
        close();
        return;
      }
      out.insert(out.end(), batch_.begin(), batch_.end());
    } while (batch_.full());
  }

  void send(std::span<const CanFrame> frames) override {
    if (!link_) {
      dropped_ += frames.size();
      return;
    }
    if (!link_->send(frames)) close();
  }

  std::string command(std::string_view) override {
    return "error: an interface of this kind has no faults of its own";
  }

  std::uint64_t dropped() const override {
    return dropped_ + (link_ ? link_->counters().send_refused : 0);
  }

 private:
  bool ready(Time now) {
    if (link_) return true;
    if (now < retry_) return false;
    retry_ = now + kRetry;
    auto opened = link::open_can(settings_);
    link_ = std::move(opened.link);
    return link_ != nullptr;
  }
  void close() {
    dropped_ += link_->counters().send_refused;
    link_.reset();
  }

  link::CanSettings settings_;
  std::unique_ptr<link::CanLink> link_;
  link::FrameBatch batch_;
  Time retry_ = kNever;
  std::uint64_t dropped_ = 0;
};

}  // namespace

std::unique_ptr<CanPort> make_socketcan_port(const std::string& interface) {
  return std::make_unique<SocketCanPort>(interface);
}

}  // namespace drover::sim
