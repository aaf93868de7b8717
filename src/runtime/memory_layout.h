// How the two records of a robot's memory lie in its file, and how a file that the version before
// this one left becomes one of today.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "drover/remembered.h"
#include "store/durable_file.h"

namespace drover::runtime {

inline constexpr std::uint64_t kMemoryLayout = 0x64726d656d303038;  // "drmem008"
/// Of the same size: it did not tell how far away a doubted place may be.
inline constexpr std::uint64_t kMemoryLayoutWithoutHowFar = 0x64726d656d303037;  // "drmem007"
/// Nor whether it was doubted.
inline constexpr std::uint64_t kMemoryLayoutWithoutDoubt = 0x64726d656d303036;  // "drmem006"

template <class Kept>
struct MemoryRecord {
  static_assert(std::is_trivially_copyable_v<Kept>);

  std::uint64_t format = 0;
  std::uint64_t sequence = 0;  ///< 0: never written
  std::array<char, 40> boot{};
  std::uint64_t configuration = 0;
  Kept remembered;
  std::uint64_t checksum = 0;  ///< of all bytes before it

  bool never_written() const { return sequence == 0 && format == 0; }
  std::uint64_t sum() const {
    return store::fingerprint(
        {reinterpret_cast<const char*>(this), offsetof(MemoryRecord, checksum)});
  }
};

/// A file of the layouts before is written anew, whole or not at all; a record of it that is
/// damaged stays one. Any other file is left as it is. Returns the step that failed, with errno;
/// nullptr when none did.
const char* raise_memory_layout(const std::string& path);

}  // namespace drover::runtime
