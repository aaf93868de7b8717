#include "drivers/gt01/can/driver.h"

#include <algorithm>
#include <cmath>

#include "drivers/checked_options.h"
#include "drivers/gt01/words.h"

namespace drover::gt01::can {
namespace {

constexpr std::string_view kLayouts[] = {"example", "table"};
constexpr FrameRule kRules[] = {{.id = kCommandId, .min_len = 8, .max_len = 8}};
/// Commands, 10 to 12, 20, 30, 41.
constexpr FrameFilter kHears[] = {{kCommandId}, {0x10, 0x7FC}, {0x20}, {0x30}, {0x41}};
/// What it tells is whole millimetres a second.
constexpr double kSigma_mps = 0.002;
/// Until it was measured how long one goes on without commands: the maker's words are only that it
/// stops.
constexpr double kSilence_s = 1.0;
constexpr unsigned kFaultBits = 16;
constexpr Words kWords{.motion = "no speed (0x10)", .state = "no state (0x20)"};

struct Trouble {
  std::uint8_t bit;
  std::string_view text;
};
constexpr Trouble kTroubles[] = {
    {status::kHardEstop, words::kHardEstop},   {status::kRemoteEstop, words::kRemoteEstop},
    {status::kSoftEstop, words::kSoftEstop},   {status::kFrontBumper, words::kFrontBumper},
    {status::kRearBumper, words::kRearBumper},
};

std::string_view text_of_status(std::uint8_t bits) {
  const auto* const found =
      std::find_if(std::begin(kTroubles), std::end(kTroubles),
                   [&](const Trouble& each) { return (bits & each.bit) != 0; });
  return found == std::end(kTroubles) ? std::string_view() : found->text;
}

/// The first fault of either motor, in words.
Reason text_of(const MotorFaults& faults) {
  Reason text;
  for (const auto& [side, bits] : {std::pair{"left", faults.left}, {"right", faults.right}}) {
    for (unsigned bit = 0; bit < kFaultBits && text.empty(); ++bit) {
      if ((bits >> bit & 1U) == 0) continue;
      const char* const word = motor_fault(bit);
      text.format("%s motor: %s", side, *word != '\0' ? word : "a fault without a name");
    }
  }
  return text;
}

Reason trouble_of(const State& state, const MotorFaults& faults) {
  const auto person = text_of_status(state.status);
  if (!person.empty()) return person;
  if (const Reason motors = text_of(faults); !motors.empty()) return motors;
  if ((state.error & error::kDriveOffline) != 0) return "a drive of the chassis is off line";
  if ((state.error & error::kDriveError) != 0) return "a drive of the chassis reports a fault";
  if (state.mode == static_cast<std::uint8_t>(Mode::remote)) return Reason(words::kRemote);
  if (state.mode == static_cast<std::uint8_t>(Mode::docking)) return Reason(words::kDocking);
  return {};
}

StopRecipe recipe_of(const Settings& settings, TwistLayout layout) {
  StopRecipe recipe;
  StopRound zero;
  static_cast<void>(zero.frames.push_back(motion({}, layout)));
  static_cast<void>(recipe.rounds.push_back(zero));
  recipe.ends = ends_of(settings);
  return recipe;
}

}  // namespace

std::span<const OptionSpec> option_table() {
  static const auto kOptions = [] {
    std::array<OptionSpec, std::tuple_size_v<CommonOptions> + 1> all;
    const CommonOptions common = common_options(kSilence_s);
    std::copy(common.begin(), common.end(), all.begin());
    all.back() = {.name = "twist_layout",
                  .default_value = std::string("example"),
                  .choices = kLayouts,
                  .text =
                      "where the twist stands in its frame: the maker's examples put 01 01 "
                      "before it, his table does not"};
    return all;
  }();
  return kOptions;
}

TwistLayout read_layout(const Options& options) {
  const CheckedOptions checked(options, option_table());
  return checked.text("twist_layout") == "table" ? TwistLayout::table : TwistLayout::example;
}

Gt01CanDriver::Gt01CanDriver(const Settings& settings, TwistLayout layout, AxisId axis)
    : settings_(settings),
      layout_(layout),
      host_(settings, axis, kWords),
      recipe_(recipe_of(settings, layout)),
      silence_text_(silence_text(settings)) {}

std::span<const FrameFilter> Gt01CanDriver::listens() const {
  return kHears;
}

std::span<const FrameRule> Gt01CanDriver::rules() const {
  return kRules;
}

void Gt01CanDriver::on_link_up(Time now) {
  state_.reset();
  motor_faults_ = {};
  host_.on_link_up(now);
}

void Gt01CanDriver::tell_condition(Time received, DriverOut& out) {
  if (!state_) return;
  Condition condition;
  condition.at = state_at_;
  condition.obeys = state_->mode == static_cast<std::uint8_t>(Mode::host);
  condition.remote_on = (state_->status & status::kRemoteOffline) == 0;
  condition.bits = static_cast<std::uint64_t>(state_->status & ~status::kRemoteOffline) |
                   static_cast<std::uint64_t>(state_->error) << 8U |
                   static_cast<std::uint64_t>(motor_faults_.left) << 16U |
                   static_cast<std::uint64_t>(motor_faults_.right) << 32U;
  condition.trouble = trouble_of(*state_, motor_faults_);
  condition.powered = (state_->status & status::kHardEstop) == 0;
  condition.stops_all = !text_of_status(state_->status).empty();
  host_.on_condition(condition, received, out);
}

void Gt01CanDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  if (frame.id == kCommandId) {
    if (!is_of_recipe(frame, recipe_)) host_.on_foreign(frame.id, received);
    return;
  }
  const bool own = std::any_of(std::begin(kHears), std::end(kHears),
                               [&](const FrameFilter& each) { return each.matches(frame); });
  if (!own || frame.id == 0x13) return;  // the remote control's sticks are nobody's business here
  const auto report = decode(frame);
  if (!report) return host_.on_bad();
  host_.on_good(received);
  if (const auto* motion = std::get_if<Motion>(&*report)) {
    host_.on_motion(motion->twist, kSigma_mps, received, out);
  } else if (const auto* state = std::get_if<State>(&*report)) {
    state_ = *state;
    state_at_ = received;
    host_.on_supply(state->voltage_V, received, out);
    tell_condition(received, out);
  } else if (const auto* faults = std::get_if<MotorFaults>(&*report)) {
    motor_faults_ = *faults;
    tell_condition(received, out);
  }
}

void Gt01CanDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut&) {
  host_.on_setpoints(wanted, now);
}

void Gt01CanDriver::on_tick(Time now, DriverOut& out) {
  if (const auto twist = host_.on_tick(now)) out.send(motion(*twist, layout_));
  host_.report_status(now, out);
}

/// As the wire says it. Nothing stands behind the twist.
std::optional<Twist> Gt01CanDriver::asked(const Message& message) const {
  if (message.frame() == nullptr) return std::nullopt;
  const auto twist = asked_twist(*message.frame(), layout_);
  if (!twist || *message.frame() != motion(*twist, layout_)) return std::nullopt;
  return twist;
}

Twist Gt01CanDriver::setpoint_twist(const Message& message, std::size_t) const {
  const auto twist = asked(message);
  return twist ? host_.true_of(*twist) : Twist{kAbsent, kAbsent};
}

Effect Gt01CanDriver::effect(const Message& message, Time) const {
  return effect_of(asked(message));
}

}  // namespace drover::gt01::can
