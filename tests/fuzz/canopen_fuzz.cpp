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
#include "tests/fuzz/input.h"

namespace {

using namespace drover;
using namespace drover::canopen;
using namespace drover::fuzz;

constexpr std::uint8_t kNode = 5;
constexpr Duration kPatience = std::chrono::milliseconds(200);

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
    switch (kind & 3U) {
      case 0: {
        CanFrame answer;
        answer.id = 0x580U + kNode;
        read_data(input, answer);
        hear(client, answer, now);
        break;
      }
      case 1: {
        const std::uint32_t id = input.word();
        hear(client, read_frame(input, id), now);
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
