// Any frames and pauses into the CANopen pieces: no crash, and whatever a node answers makes the
// client say nothing but "the next segment" or "no more" to that node; it waits for nobody for
// ever.
//
// Input: steps. A step's first byte is its kind (2 bits):
//   0  an answer of the node: length, that many bytes
//   1  a frame of any id: two bytes of id, flags, length, bytes
//   2  a question: two bytes of index, one of subindex; bit 2 of the kind: a write
//   3  a pause of 5 ms times a byte
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/canopen/cia402.h"
#include "drivers/canopen/emcy.h"
#include "drivers/canopen/nmt.h"
#include "drivers/canopen/sdo_client.h"

namespace {

using namespace drover;
using namespace drover::canopen;

constexpr std::uint8_t kNode = 5;
constexpr Duration kPatience = std::chrono::milliseconds(200);

/// What comes in, read to its end and zero beyond.
class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool more() const { return at_ < bytes_.size(); }
  std::uint8_t byte() { return more() ? bytes_[at_++] : std::uint8_t{0}; }
  std::uint16_t word() { return static_cast<std::uint16_t>(byte() | byte() << 8U); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

void read_data(Input& input, CanFrame& frame) {
  frame.len = input.byte() % (frame.data.size() + 1);
  for (std::uint8_t i = 0; i < frame.len && input.more(); ++i) frame.data[i] = input.byte();
}

void expect(bool true_sentence) {
  if (!true_sentence) std::abort();
}

void is_harmless(const std::optional<CanFrame>& frame) {
  if (!frame) return;
  expect(frame->id == 0x600U + kNode && frame->len == 8 && !frame->extended && !frame->remote);
  const std::uint8_t command = frame->data[0];
  expect(command == 0x60 || command == 0x70 || command == 0x80);
}

void look_at(SdoClient& client) {
  const auto outcome = client.take_outcome();
  if (!outcome) return;
  expect(!client.busy());
  expect(outcome->data.size() <= 64);
  expect(!outcome->number() || outcome->data.size() <= 4);
  expect(!abort_text(outcome->code).empty());
}

void hear(SdoClient& client, const CanFrame& frame, Time now) {
  is_harmless(client.on_frame(frame, now));
  look_at(client);
  if (const auto beat = decode_heartbeat(frame)) expect(beat->node >= 1 && beat->node <= 127);
  if (const auto emergency = decode_emergency(frame, kNode))
    expect(!emergency_text(emergency->code).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input({data, size});
  SdoClient client(kNode, kPatience);
  Time now{};
  while (input.more()) {
    const std::uint8_t kind = input.byte();
    CanFrame frame;
    switch (kind & 3U) {
      case 0:
        frame.id = 0x580U + kNode;
        read_data(input, frame);
        hear(client, frame, now);
        break;
      case 1: {
        frame.id = input.word();
        const std::uint8_t flags = input.byte();
        frame.extended = (flags & 1U) != 0;
        frame.remote = (flags & 2U) != 0;
        frame.fd = (flags & 4U) != 0;
        frame.error = (flags & 8U) != 0;
        read_data(input, frame);
        hear(client, frame, now);
        break;
      }
      case 2: {
        const Object object{input.word(), input.byte()};
        if (client.busy()) break;
        if ((kind & 4U) != 0) {
          client.write(object, u32(1), now);
        } else {
          client.read(object, now);
        }
        break;
      }
      default:
        now += std::chrono::milliseconds(5 * input.byte());
        is_harmless(client.on_tick(now));
        look_at(client);
    }
    const auto state = drive_state(static_cast<std::uint16_t>(kind * 257U));
    expect(!text(state).empty());
  }
  now += kPatience;
  client.on_tick(now);
  expect(!client.busy());
  return 0;
}
