// A recording played again: the same gateway, fed with what was recorded, says the same, to the
// bit, or it is told where it first does not. Pure: the caller has the file in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "config/load.h"
#include "drover/snapshot.h"
#include "drover/time.h"

namespace drover::gateway {

/// The first output that differs.
struct Difference {
  std::uint64_t cycle = 0;  ///< from 1
  Time time = kNever;       ///< of that cycle
  std::string what;         ///< `pose.x_m`, `events[0]`, `frames of bus 0 [2]`
  std::string recorded;
  std::string replayed;
  std::size_t more = 0;             ///< others that differ in that cycle
  std::vector<std::string> inputs;  ///< the last ones before it, the latest last
};

struct Replayed {
  enum class Verdict : std::uint8_t { equal, differs, unusable } verdict = Verdict::unusable;
  /// unusable: why. equal: how it ended when it did not end as asked; empty otherwise.
  std::string note;
  std::string version;  ///< of the program that recorded
  std::uint64_t inputs = 0;
  std::uint64_t cycles = 0;
  Time begin = kNever;
  Time end = kNever;
  Difference difference;
  /// sin, exp and the others have other last bits here than where it was recorded: that alone may
  /// make the difference.
  bool other_mathematics = false;
  /// Values that only one of recording and program has: they were not compared.
  std::vector<std::string> not_compared;
};

/// A recording that ends within a record is one of a daemon that was killed: good until there.
/// One with a gap is unusable, and it is said how far it was equal.
Replayed replay(std::span<const std::uint8_t> file);

/// To see what the gateway makes of what was recorded, whatever the recording says of it. `cycle`
/// is called after each; `config`: in place of the recorded configuration, nullptr: that one. It is
/// unusable when the devices or links of the two are not the same, whose numbers the inputs name.
Replayed play(std::span<const std::uint8_t> file, const config::DroverConfig* config,
              const std::function<void(const Snapshot&)>& cycle);

/// What the daemon was configured as when it was recorded. Its problem: the file is no recording,
/// or the configuration is not understood.
struct RecordedConfiguration {
  std::string problem;  ///< empty: it is
  config::Loaded loaded;
};
RecordedConfiguration recorded_configuration(std::span<const std::uint8_t> file);

}  // namespace drover::gateway
