// Any bytes as a recording: no crash, and every recording that is refused says why. The first byte
// chooses: the rest is a whole file, or the records of a small robot's, of an earlier edition or of
// today's.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "config/load.h"
#include "gateway/recording/encoder.h"
#include "gateway/recording/replay.h"
#include "tests/support/small_robot.h"

namespace {

using namespace drover;
using namespace drover::gateway;

void require(bool holds) {
  if (!holds) std::abort();
}

std::vector<std::uint8_t> header(std::uint8_t edition) {
  const auto loaded =
      config::load_text(test::kSmallRobot, std::string(DROVER_SOURCE_DIR) + "/config/maps");
  require(loaded.problems.empty());
  const Gateway gateway(loaded.config);
  return written(RecordingHeader{"fuzz", loaded.text, loaded.register_map,
                                 mathematics_fingerprint(), field_names(gateway), edition});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 8192) return 0;
  static const auto kFirst = header(1);
  static const auto kSecond = header(2);
  static const auto kToday = header(kEdition);
  std::vector<std::uint8_t> file;
  if (data[0] % 8 != 0) file = (data[0] & 0x40U) == 0 ? kFirst : kToday;
  if (data[0] % 8 == 7) file = kSecond;
  file.insert(file.end(), data + 1, data + size);
  const auto it = replay(file);
  if (it.verdict == Replayed::Verdict::unusable) require(!it.note.empty());
  if (it.verdict == Replayed::Verdict::differs) require(!it.difference.what.empty());
  return 0;
}
