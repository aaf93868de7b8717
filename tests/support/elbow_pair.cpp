#include "support/elbow_pair.h"

#include "drover/driver.h"

namespace drover::test {

namespace {

constexpr Channel kElbows[] = {{"first", ChannelMode::impedance},
                               {"second", ChannelMode::impedance}};

class ElbowPair final : public Device, public FrameFace, public Actuator {
 public:
  void on_link_up(Time) override {}
  void on_tick(Time, DriverOut&) override {}
  SourceHealth health(Time) const override { return {}; }
  void on_frame(const CanFrame&, Time, DriverOut&) override {}
  std::span<const FrameFilter> listens() const override { return {}; }
  std::span<const Channel> channels() const override { return kElbows; }
  void on_setpoints(std::span<const Setpoint>, Time, DriverOut&) override {}
  std::span<const FrameRule> rules() const override { return {}; }
  Effect effect(const Message&, Time) const override { return {}; }
  StopRecipe stop_recipe() const override { return {}; }
  SilenceBehaviour silence() const override {
    return {true, std::chrono::seconds(1), "goes limp after 1 s", StopEnds::coasts};
  }
};

Made make(const Options&, const MakeContext&) {
  return make_device<ElbowPair>();
}

}  // namespace

const DriverEntry kElbowPairEntry{.name = "elbow_pair",
                                  .folder = "elbow_pair",
                                  .options = {},
                                  .kind = SlotKind::drive,
                                  .wire = Wire::can,
                                  .channels = kElbows,
                                  .make = make,
                                  .twin_options = {},
                                  .make_twin = {},
                                  .summary = "two joints that nobody builds"};

}  // namespace drover::test
