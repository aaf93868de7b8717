// Golden files: bytes with provenance and what a driver makes of them, one case a line.
//
//   # source: ..., # provenance: captured | test of ... | computed   (both are required)
//   option <name> = <value>           before the first case; true/false, a number or a text
//   map <file in config/maps>         the same, for drivers that read registers
//   frame 069#00004841000050C0 => axis_motion axis=0 position_rad=78.5398 ...
//   bytes "$GPGGA,...*47\r\n" => gnss_position ...      text with \r \n \\ \" and \xHH
//   bytes B562 0107 => ...                              or hex
//   exchange 0103... 0103... => battery ...             request and answer of Modbus RTU: what the
//                                                       map's fields inside these registers mean
//
// Right of the arrow stands what test::describe() gives for the call, with " and bad" behind it
// when the bad counter rose too, or
//   nothing   understood or swallowed: no measurement, nothing counted as bad
//   ignored   no measurement, and no counter moves
//   bad       no measurement, and the bad counter rises
// The cases of a file run in order through one driver, 10 ms apart. A status that a driver repeats
// in its ticks is not part of it: ticks are not called.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drover/can_frame.h"
#include "drover/registry.h"

namespace drover::test {

struct GoldenCase {
  int line = 0;
  bool is_frame = false;
  bool is_exchange = false;
  CanFrame frame;
  std::vector<std::uint8_t> bytes;
  std::string expected;
};

struct GoldenFile {
  std::filesystem::path path;
  bool has_source = false;
  bool has_provenance = false;
  Options options;
  std::string map;
  std::vector<GoldenCase> cases;
};

/// Throws std::runtime_error with file and line.
GoldenFile read_golden(const std::filesystem::path& path, const DriverEntry& entry);
/// All .txt files below drivers/<folder>/golden, sorted by name.
std::vector<GoldenFile> read_goldens(const std::filesystem::path& source_dir,
                                     const DriverEntry& entry);

}  // namespace drover::test
