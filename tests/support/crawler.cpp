#include "support/crawler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "drivers/gpio_line/entry.h"
#include "drivers/modbus_bms/entry.h"
#include "drivers/nmea0183/entry.h"
#include "drivers/odrive/entry.h"
#include "drivers/witmotion/entry.h"
#include "drover/bytes.h"
#include "support/elbow_pair.h"

namespace drover::test {

namespace crawler {

namespace {
constexpr std::uint8_t kHead = 0xC5;

std::uint8_t sum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint8_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

void put(Packet& out, double value) {
  // Towards rest.
  const auto thousandths = static_cast<std::uint16_t>(static_cast<std::int16_t>(value * 1000));
  (void)out.push_back(static_cast<std::uint8_t>(thousandths & 0xFFU));
  (void)out.push_back(static_cast<std::uint8_t>(thousandths >> 8U));
}

double get(std::span<const std::uint8_t> bytes) {
  return static_cast<std::int16_t>(bytes[0] | (bytes[1] << 8U)) / 1000.0;
}
}  // namespace

Packet packet(std::uint8_t what, const Twist& twist) {
  Packet out;
  (void)out.push_back(kHead);
  (void)out.push_back(what);
  put(out, twist.vx_mps);
  put(out, twist.wz_radps);
  (void)out.push_back(sum({out.data(), out.size()}));
  return out;
}

std::optional<Said> read(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kSize || bytes[0] != kHead || bytes[kSize - 1] != sum(bytes.first(kSize - 1)))
    return std::nullopt;
  return Said{bytes[1], {get(bytes.subspan(2)), get(bytes.subspan(4))}};
}

}  // namespace crawler

namespace {

using namespace crawler;

constexpr Channel kBase{"base", ChannelMode::twist};
constexpr Duration kStale = std::chrono::milliseconds(200);

class Crawler final : public Device, public ByteFace, public Actuator {
 public:
  Crawler(bool stops, AxisId axis) : stops_(stops), axis_(axis) {}

  void on_link_up(Time) override { size_ = 0; }
  void on_tick(Time, DriverOut& out) override {
    out.send(wanted_.request == AxisRequest::idle ? packet(kLetGo) : packet(kDrive, wanted_.twist));
  }
  SourceHealth health(Time now) const override {
    SourceHealth health;
    health.last_good = heard_;
    if (heard_ == kNever) return health;
    health.state = now - heard_ <= kStale ? SourceState::fresh : SourceState::stale;
    if (health.state == SourceState::stale) health.reason = "the crawler is silent";
    return health;
  }
  Reason words(const Measurement& reported) const override {
    const auto* const status = std::get_if<AxisStatus>(&reported.value);
    const bool fault = status != nullptr && status->state == AxisState::fault;
    return fault ? "a stone in the track" : "";
  }
  void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) override {
    for (const auto byte : bytes) {
      std::rotate(window_.begin(), window_.begin() + 1, window_.end());
      window_.back() = byte;
      size_ = std::min(size_ + 1, kSize);
      if (size_ < kSize) continue;
      if (const auto said = read(window_)) take(*said, first_byte, out);
    }
  }
  std::span<const Channel> channels() const override { return {&kBase, 1}; }
  void on_setpoints(std::span<const Setpoint> wanted, Time, DriverOut&) override {
    wanted_ = wanted[0];
    if (wanted_.request == AxisRequest::rest) wanted_.twist = {};
  }
  std::span<const FrameRule> rules() const override { return {}; }
  Effect effect(const Message& message, Time) const override {
    const auto asked = read(message.payload());
    if (!asked || asked->what < kDrive || asked->what > kLetGo) return {};
    const bool stands = asked->twist.vx_mps == 0 && asked->twist.wz_radps == 0;
    return stands ? Effect{FrameEffect::stop, 0} : Effect{FrameEffect::motion, 1};
  }
  Twist setpoint_twist(const Message& message, std::size_t) const override {
    const auto asked = read(message.payload());
    return asked && asked->what == kDrive ? asked->twist : Twist{kAbsent, kAbsent};
  }
  StopRecipe stop_recipe() const override {
    StopRecipe recipe;
    StopRound round;
    (void)round.packets.push_back(packet(kDrive));
    (void)recipe.rounds.push_back(round);
    recipe.period = std::chrono::milliseconds(20);
    recipe.ends = StopEnds::holds;
    return recipe;
  }
  SilenceBehaviour silence() const override {
    return {stops_, std::chrono::milliseconds(200),
            stops_ ? "stops after 0.2 s" : "goes on for ever as it was told last"};
  }

 private:
  void take(const Said& said, Time at, DriverOut& out) {
    if (said.what == kGreets) out.send(packet(kDrive));
    if (said.what < kIsIdle || said.what > kFault) return;
    heard_ = at;
    AxisStatus status;
    status.axis = axis_;
    status.state = said.what == kRuns     ? AxisState::running
                   : said.what == kIsIdle ? AxisState::idle
                                          : AxisState::fault;
    out.report({at, at, status});
    BodyMotion motion;
    motion.twist = said.twist;
    motion.vx_var = motion.wz_var = 1e-4;
    motion.known = true;
    out.report({at, at, motion});
  }

  bool stops_;
  AxisId axis_;
  Setpoint wanted_;
  Time heard_ = kNever;
  std::array<std::uint8_t, kSize> window_{};
  std::size_t size_ = 0;
};

constexpr OptionSpec kOptions[] = {
    {.name = "stops", .default_value = true, .text = "by itself, when nobody speaks to it"}};

constexpr int kBauds[] = {115200};

Made make(const Options& options, const MakeContext& context) {
  return make_device<Crawler>(options.flag("stops"), context.axis(0));
}

}  // namespace

const DriverEntry kCrawlerEntry{.name = "crawler",
                                .folder = "crawler",
                                .options = kOptions,
                                .kind = SlotKind::drive,
                                .wire = Wire::bytes,
                                .bauds = kBauds,
                                .channels = {&kBase, 1},
                                .make = make,
                                .twin_options = {},
                                .make_twin = {},
                                .summary = "a chassis that nobody builds"};

}  // namespace drover::test

/// In place of the product's table.
namespace drover {

std::span<const DriverEntry> driver_registry() {
  static const std::array kTable{kOdriveEntry,         kGpioLineEntry,  kNmea0183Entry,
                                 kModbusBmsEntry,      kWitmotionEntry, test::kCrawlerEntry,
                                 test::kElbowPairEntry};
  return kTable;
}

}  // namespace drover
