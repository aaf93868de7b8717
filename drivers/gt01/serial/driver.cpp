#include "drivers/gt01/serial/driver.h"

#include <algorithm>
#include <cmath>

#include "drivers/gt01/words.h"

namespace drover::gt01::serial {
namespace {

/// What it tells is whole millimetres a second.
constexpr double kStep_mps = 0.002;
constexpr std::uint16_t kStopPackets = 16;
/// Both are in one packet.
constexpr Words kWords{.motion = "no upload (0x81)", .state = "no upload (0x81)"};

struct Trouble {
  std::uint16_t bit;
  std::string_view text;
};
constexpr std::uint16_t kStopsAll = status::kHardEstop | status::kRemoteEstop | status::kSoftEstop |
                                    status::kFrontBumper | status::kRearBumper;
/// The first that is set is told: what a person has done comes before what the drives say.
constexpr Trouble kTroubles[] = {
    {status::kHardEstop, words::kHardEstop},
    {status::kRemoteEstop, words::kRemoteEstop},
    {status::kSoftEstop, words::kSoftEstop},
    {status::kFrontBumper, words::kFrontBumper},
    {status::kRearBumper, words::kRearBumper},
    {status::kFrontDriveOffline, "the front drive is off line"},
    {status::kRearDriveOffline, "the rear drive is off line"},
    {status::kFrontLeftError, "the front left drive reports a fault"},
    {status::kFrontRightError, "the front right drive reports a fault"},
    {status::kRearLeftError, "the rear left drive reports a fault"},
    {status::kRearRightError, "the rear right drive reports a fault"},
    {status::kDockingOn, words::kDocking},
};

Condition condition_of(const Upload& upload, Time received) {
  Condition condition;
  condition.at = received;
  condition.remote_on = (upload.status & status::kRemoteOffline) == 0;
  condition.bits = static_cast<std::uint16_t>(upload.status & ~status::kRemoteOffline);
  const auto* const found =
      std::find_if(std::begin(kTroubles), std::end(kTroubles),
                   [&](const Trouble& each) { return (upload.status & each.bit) != 0; });
  if (found != std::end(kTroubles)) condition.trouble.assign(found->text);
  condition.powered = (upload.status & status::kHardEstop) == 0;
  condition.stops_all = (upload.status & kStopsAll) != 0;
  return condition;
}

/// What the wheels of a side contradict each other by.
double sigma_mps(const Upload& upload) {
  const auto& wheels = upload.wheels_mps;
  const double spread_mps =
      std::max(std::abs(wheels[0] - wheels[2]), std::abs(wheels[1] - wheels[3]));
  return std::max(kStep_mps, spread_mps);
}

}  // namespace

std::span<const OptionSpec> option_table() {
  static const CommonOptions kOptions = common_options(0.0);
  return kOptions;
}

Gt01SerialDriver::Gt01SerialDriver(const Settings& settings, AxisId axis)
    : settings_(settings), host_(settings, axis, kWords), silence_text_(silence_text(settings)) {}

void Gt01SerialDriver::on_link_up(Time now) {
  framer_.reset();
  host_.on_link_up(now);
}

void Gt01SerialDriver::on_upload(const Upload& upload, Time received, DriverOut& out) {
  host_.on_motion(upload.twist, sigma_mps(upload), received, out);
  host_.on_supply(upload.voltage_V, received, out);
  host_.on_condition(condition_of(upload, received), received, out);
}

void Gt01SerialDriver::on_bytes(std::span<const std::uint8_t> bytes, Time first_byte,
                                DriverOut& out) {
  framer_.push(
      bytes,
      [&](std::span<const std::uint8_t> packet) {
        const auto report = decode(packet);
        if (!report) return host_.on_bad();
        host_.on_good(first_byte);
        if (const auto* upload = std::get_if<Upload>(&*report)) on_upload(*upload, first_byte, out);
      },
      [&] { host_.on_bad(); });
}

void Gt01SerialDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut&) {
  host_.on_setpoints(wanted, now);
}

void Gt01SerialDriver::on_tick(Time now, DriverOut& out) {
  if (const auto twist = host_.on_tick(now)) out.send(motion(sequence_++, *twist));
  host_.report_status(now, out);
}

/// As the wire says it.
std::optional<Twist> Gt01SerialDriver::asked(const Message& message) const {
  if (message.packet() == nullptr) return std::nullopt;
  return asked_twist(message.payload());
}

Twist Gt01SerialDriver::setpoint_twist(const Message& message, std::size_t) const {
  const auto twist = asked(message);
  return twist ? host_.true_of(*twist) : Twist{kAbsent, kAbsent};
}

Effect Gt01SerialDriver::effect(const Message& message, Time) const {
  return effect_of(asked(message));
}

/// Nothing is said of what a sequence number does that comes twice: these are as many as there is
/// room for.
StopRecipe Gt01SerialDriver::stop_recipe() const {
  StopRecipe recipe;
  for (std::uint16_t i = 0; i < kStopPackets; ++i) {
    StopRound zero;
    static_cast<void>(zero.packets.push_back(motion(i, {})));
    static_cast<void>(recipe.rounds.push_back(zero));
  }
  recipe.ends = ends_of(settings_);
  return recipe;
}

}  // namespace drover::gt01::serial
