#include "gateway/recording/earlier_editions.h"

#include <algorithm>
#include <optional>

#include "gateway/recording/bytes.h"

namespace drover::gateway {

namespace {

template <class Body>
constexpr std::uint8_t kind_now() {
  return static_cast<std::uint8_t>(InputBody(Body{}).index());
}

/// What became of a kind of the first edition: its number now, and what it has to be given: which
/// number of a link or slot stands before its members, or what it did not tell behind them.
struct Translation {
  enum class Adds : std::uint8_t {
    nothing,
    stream,   ///< instead of the stream's number
    chip,     ///< the link of the lines
    lost,     ///< the same, and no reason behind it
    battery,  ///< its slot
    line_of_battery,
    memory,  ///< behind it: joint commands wait for nothing, not known to rest, no wheel ran away
  };
  std::uint8_t kind = 0;
  Adds adds = Adds::nothing;
};

using Adds = Translation::Adds;

/// In the order of the first edition.
const Translation kTranslations[] = {
    {kind_now<FrameHeard>()},
    {kind_now<BytesHeard>(), Adds::stream},
    {kind_now<LevelsRead>(), Adds::chip},
    {kind_now<LinkLost>(), Adds::lost},  // lines lost
    {kind_now<RegistersRead>(), Adds::battery},
    {kind_now<RegistersFailed>(), Adds::battery},
    {kind_now<LinkUp>(), Adds::line_of_battery},
    {kind_now<LinkUp>()},    // of a bus
    {kind_now<LinkLost>()},  // of a bus
    {kind_now<FramesSent>()},
    {kind_now<LinkUp>(), Adds::stream},
    {kind_now<CommandGiven>()},
    {kind_now<Tick>()},
    {kind_now<ProgramTrouble>()},
    {kind_now<Suspended>()},
    {kind_now<Recalled>(), Adds::memory},
    {kind_now<OutputsUp>()},
};

/// The slot of this kind; kNowhere when there is none.
SlotId slot_of(const Wiring& wiring, SlotKind kind) {
  const auto it = std::find_if(wiring.slots.begin(), wiring.slots.end(),
                               [kind](const Slot& slot) { return slot.kind == kind; });
  return it == wiring.slots.end() ? kNowhere : static_cast<SlotId>(it - wiring.slots.begin());
}

/// What was remembered gets so many more flags, not set.
std::vector<std::uint8_t> with_flags(std::span<const std::uint8_t> record, std::size_t more) {
  std::vector<std::uint8_t> today(record.begin(), record.end());
  if (!today.empty() && today.front() == kind_now<Recalled>()) today.resize(today.size() + more);
  return today;
}

/// The body of the command that a record is, and `in` behind its number; empty: it is none.
std::optional<std::size_t> read_body(ByteReader& in) {
  const auto kind = in.byte();
  (void)in.signed_number();  // time
  (void)in.byte();           // whose request
  (void)in.number();
  (void)in.signed_number();  // when it came
  const std::size_t body = in.byte();
  if (kind != kind_now<CommandGiven>() || !in.good()) return {};
  return body;
}

std::optional<std::size_t> body_of(std::span<const std::uint8_t> record) {
  ByteReader in(record);
  return read_body(in);
}

template <class Body>
constexpr std::size_t body_now() {
  return decltype(Command::body)(Body{}).index();
}

LinkId link_of(const Wiring& wiring, SlotKind kind) {
  const SlotId slot = slot_of(wiring, kind);
  return slot == kNowhere ? kNowhere : wiring.slots[slot].link;
}

}  // namespace

std::vector<LinkId> streams_of_first_edition(const Wiring& wiring) {
  return {link_of(wiring, SlotKind::gnss), link_of(wiring, SlotKind::imu)};
}

std::vector<std::uint8_t> from_first_edition(std::span<const std::uint8_t> record,
                                             const Wiring& wiring) {
  ByteReader in(record);
  const auto kind = in.byte();
  const auto time = in.signed_number();
  if (!in.good() || kind >= std::size(kTranslations)) return {};
  const auto& [kind_now, adds] = kTranslations[kind];
  std::vector<std::uint8_t> buffer(record.size() + 16);
  ByteWriter out(buffer);
  out.byte(kind_now);
  out.signed_number(time);
  switch (adds) {
    case Adds::nothing:
    case Adds::memory: break;
    case Adds::stream: {
      const auto streams = streams_of_first_edition(wiring);
      out.byte(streams[in.below(streams.size())]);
      break;
    }
    case Adds::chip: out.byte(link_of(wiring, SlotKind::line)); break;
    case Adds::lost:
      out.byte(link_of(wiring, SlotKind::line));
      out.text("");
      break;
    case Adds::battery: out.byte(slot_of(wiring, SlotKind::battery)); break;
    case Adds::line_of_battery: out.byte(link_of(wiring, SlotKind::battery)); break;
  }
  out.bytes(in.left());
  if (adds == Adds::memory) {
    out.text("");
    for (int flag = 0; flag < 3; ++flag) out.byte(0);
  }
  if (!in.good() || !out.good()) return {};
  buffer.resize(out.written().size());
  return buffer;
}

std::vector<std::uint8_t> from_second_edition(std::span<const std::uint8_t> record) {
  return with_flags(record, 3);
}

std::vector<std::uint8_t> from_third_edition(std::span<const std::uint8_t> record) {
  return with_flags(record, 2);
}

std::vector<std::uint8_t> from_fourth_edition(std::span<const std::uint8_t> record) {
  return with_flags(record, 1);
}

std::vector<std::uint8_t> from_fifth_edition(std::span<const std::uint8_t> record) {
  std::vector<std::uint8_t> today(record.begin(), record.end());
  const auto body = body_of(record);
  if (body == body_now<FollowTwist>() || body == body_now<TwistRefused>()) today.push_back(0);
  return today;
}

std::vector<std::uint8_t> from_sixth_edition(std::span<const std::uint8_t> record) {
  std::vector<std::uint8_t> today(record.begin(), record.end());
  // Nothing went sideways: a zero.
  if (body_of(record) == body_now<FollowTwist>()) today.resize(today.size() + sizeof(double), 0);
  return today;
}

std::vector<std::uint8_t> from_seventh_edition(std::span<const std::uint8_t> record) {
  constexpr std::size_t kAside = 5;  // numbers
  std::vector<std::uint8_t> today(record.begin(), record.end());
  // Nobody looked to the sides: zeros.
  if (!today.empty() && today.front() == kind_now<ClearanceFound>())
    today.resize(today.size() + kAside * sizeof(double), 0);
  return today;
}

std::vector<std::uint8_t> from_eighth_edition(std::span<const std::uint8_t> record) {
  constexpr std::string_view kWasThere =
      "droverd has only just come, and nobody's commands are followed yet";
  std::vector<std::uint8_t> today(record.begin(), record.end());
  ByteReader in(record);
  if (read_body(in) != body_now<JointTargetsRefused>()) return today;
  const auto reason = in.text();
  if (in.done()) today.push_back(reason == kWasThere ? 1 : 0);
  return today;
}

}  // namespace drover::gateway
