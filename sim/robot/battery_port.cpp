#include "sim/robot/battery_port.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "drover/checksum.h"
#include "link/modbus_frame.h"

namespace drover::sim {
namespace {

using namespace std::chrono_literals;

constexpr std::array<std::string_view, 9> kWords{
    "well", "silent", "slow", "other_unit", "wrong_crc", "drip", "echo", "deaf_echo", "exception"};
constexpr Duration kLook = 20ms;
constexpr Duration kThinking = 10ms;
constexpr Duration kSlow = 3s;
constexpr Duration kDrip = 490ms;
constexpr Duration kRequestEnds = 50ms;  ///< a request that is not whole by then is forgotten

std::vector<std::uint8_t> sealed(std::vector<std::uint8_t> frame) {
  const auto crc = modbus_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}

}  // namespace

BatteryPort::BatteryPort(const std::string& link_path, int baud)
    : link_path_(link_path), pacer_(baud) {
  plug();
}

BatteryPort::~BatteryPort() {
  ::unlink(link_path_.c_str());
}

void BatteryPort::plug() {
  if (pty_) return;
  pty_ = open_pty();
  // Kept open, the line would look as if somebody listened; closed, the last settings stay raw.
  pty_->slave.reset();
  ::unlink(link_path_.c_str());
  if (::symlink(pty_->slave_path.c_str(), link_path_.c_str()) != 0)
    throw std::runtime_error(link_path_ + ": cannot link: " + std::strerror(errno));
}

std::string BatteryPort::command(std::string_view word, std::size_t device) {
  if (word == "plug") {
    plug();
    return "ok";
  }
  if (word == "unplug") {
    ::unlink(link_path_.c_str());
    pty_.reset();
    heard_.clear();
    answers_.clear();
    return "ok";
  }
  const auto it = std::find(kWords.begin(), kWords.end(), word);
  if (it == kWords.end())
    return "error: say: battery soc P, charger plug|unplug, unplug, plug, well, silent, slow, "
           "other_unit, wrong_crc, drip, echo, deaf_echo or exception";
  units_.at(device).fault = static_cast<LineFault>(it - kWords.begin());
  answers_.clear();
  return "ok";
}

void BatteryPort::pump(Time now, Duration tick) {
  if (!pty_) return;
  // A system call for each tick is dear where they are slow.
  if (now >= next_look_) {
    next_look_ = now + kLook;
    take(now);
  }
  send(now, tick);
}

void BatteryPort::take(Time now) {
  std::array<std::uint8_t, 256> chunk{};
  const auto n = ::read(pty_->master.get(), chunk.data(), chunk.size());
  if (n <= 0) {
    if (!heard_.empty() && now - heard_at_ > kRequestEnds) heard_.clear();
    return;
  }
  heard_.insert(heard_.end(), chunk.begin(), chunk.begin() + n);
  heard_at_ = now;
  while (heard_.size() >= link::kRtuRequestSize) {
    answer({heard_.data(), link::kRtuRequestSize}, now);
    heard_.erase(heard_.begin(), heard_.begin() + link::kRtuRequestSize);
  }
}

void BatteryPort::answer(std::span<const std::uint8_t> request, Time now) {
  ++requests_;
  // The adapter's own fault, whoever is asked.
  const auto echo = [](const Unit& unit) {
    return unit.fault == LineFault::echo || unit.fault == LineFault::deaf_echo;
  };
  if (std::any_of(units_.begin(), units_.end(), echo))
    answers_.push_back({now, {request.begin(), request.end()}});
  for (const Unit& unit : units_)
    if (request[0] == unit.address) return answer(unit, request, now);
}

void BatteryPort::answer(const Unit& asked, std::span<const std::uint8_t> request, Time now) {
  const LineFault fault = asked.fault;
  const auto word = [&](std::size_t at) {
    return static_cast<std::uint16_t>(request[at] << 8U | request[at + 1]);
  };
  const auto crc = modbus_crc(request.first(6));
  const bool good = request[6] == (crc & 0xFFU) && request[7] == crc >> 8U;
  if (!good || fault == LineFault::silent || fault == LineFault::deaf_echo) return;
  std::array<std::uint16_t, 125> registers{};
  const std::uint16_t count = word(4);
  const auto unit =
      static_cast<std::uint8_t>(asked.address + (fault == LineFault::other_unit ? 1 : 0));
  std::vector<std::uint8_t> frame{unit, request[1]};
  if (fault == LineFault::exception || count < 1 || count > registers.size() ||
      !asked.device->read(request[1], word(2), {registers.data(), count})) {
    frame[1] |= 0x80;
    frame.push_back(2);
  } else {
    frame.push_back(static_cast<std::uint8_t>(2 * count));
    for (std::uint16_t i = 0; i < count; ++i) {
      frame.push_back(static_cast<std::uint8_t>(registers[i] >> 8U));
      frame.push_back(static_cast<std::uint8_t>(registers[i]));
    }
  }
  frame = sealed(std::move(frame));
  if (fault == LineFault::wrong_crc) frame.back() ^= 0x55;
  answers_.push_back({now + (fault == LineFault::slow ? kSlow : kThinking), std::move(frame),
                      fault == LineFault::drip});
}

void BatteryPort::send(Time now, Duration tick) {
  if (answers_.empty() || now < answers_.front().due) return;
  auto& bytes = answers_.front().bytes;
  std::size_t size = 0;
  if (answers_.front().drips) {
    if (now < next_drip_) return;
    next_drip_ = now + kDrip;
    size = 1;
  } else {
    size = pacer_.take(bytes.size(), tick);
  }
  if (size > 0) (void)!::write(pty_->master.get(), bytes.data(), size);
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  if (bytes.empty()) answers_.pop_front();
}

}  // namespace drover::sim
