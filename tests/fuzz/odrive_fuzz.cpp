// Any frames of a bus, any requests and any pauses into the ODrive driver: no crash, no number that
// is none, nothing fresh or running without the frames that say so, and no set point but a finite
// one within the limit that was asked for.
//
// Input: a byte of options, then steps. A step's first byte is its kind (3 bits) and a command id:
//   0..3  a frame of the node: flags, length, that many bytes
//   4     a frame of any id: two bytes of id, flags, length, bytes
//   5     a request to run: a float (rad/s) and as many cycles as the upper bits say
//   6     cycles at rest, or idle when the command id is odd
//   7     a pause of 5 ms times a byte; then, by two bits of the command id, the link comes back
//         and a cycle passes in which nobody decides
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/input.h"
#include "tests/fuzz/odrive_bench.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;
using namespace drover::fuzz;

constexpr std::size_t kMaxInput = 512;
constexpr int kMaxCycles = 150;  // longer than every time-out

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  Input input({data + 1, size - 1});
  fuzz::Bench bench(data[0]);
  int cycles = 0;
  const auto repeat = [&](int times, const Setpoint& command) {
    for (int i = 0; i < times && cycles < kMaxCycles; ++i, ++cycles) bench.cycle(command);
  };
  while (input.more()) {
    const std::uint8_t step = input.byte();
    const std::uint8_t upper = step >> 3U;
    Setpoint command;
    switch (step & 7U) {
      case 4: {
        const std::uint32_t low = input.byte();
        bench.frame(read_frame(input, (static_cast<std::uint32_t>(input.byte()) << 8U | low)));
        break;
      }
      case 5:
        command.request = AxisRequest::run;
        command.velocity_radps = static_cast<double>(input.real());
        repeat(upper + 1, command);
        break;
      case 6:
        command.request = (upper & 1U) != 0 ? AxisRequest::idle : AxisRequest::rest;
        command.velocity_radps = 1;  // of no meaning without a request to run
        repeat(upper / 2 + 1, command);
        break;
      case 7:
        bench.pass(5ms * input.byte());
        if ((upper & 1U) != 0) bench.link_up();
        if ((upper & 2U) != 0) bench.undecided_cycle();
        break;
      default: bench.frame(read_frame(input, odrive::frame_id(fuzz::kNode, upper))); break;
    }
  }
  return 0;
}
