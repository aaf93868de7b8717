// The file of a recording: a line that says what it is, a header, then records. README.md tells
// the bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drover/path.h"
#include "gateway/recording/bytes.h"
#include "gateway/recording/input_codec.h"

namespace drover::gateway {

inline constexpr std::string_view kRecordingBegins = "drover recording ";  ///< "5\n"
inline constexpr std::uint8_t kEdition = 9;
inline constexpr std::size_t kMaxFields = 4096;
/// The longest record: a cycle in which everything is as large as it can be.
inline constexpr std::size_t kMaxRecord = 128 * 1024;

/// Kinds of records that are no inputs; those count from 0. Alike in all editions.
enum class RecordKind : std::uint8_t {
  output = 200,  ///< of the last Tick
  path = 201,    ///< before the command that names it
  gap = 202,     ///< the disk was too slow: from here on nothing is recorded
  end = 203,     ///< the daemon ended as asked
};

/// What a value of the output is, as the header tells with its name.
enum class FieldKind : std::uint8_t { whole = 'i', real = 'r', text = 't' };

struct FieldName {
  FieldKind kind = FieldKind::whole;
  std::string name;  ///< `axes[0].motion.velocity_radps`
  bool operator==(const FieldName&) const = default;
};

/// All that a replay needs beside the records.
struct RecordingHeader {
  std::string version;  ///< of the program
  std::string configuration;
  std::string register_map;       ///< of the batteries, as config::Loaded has it; empty: none
  std::uint64_t mathematics = 0;  ///< mathematics_fingerprint() where it was recorded
  std::vector<FieldName> fields;
  std::uint8_t edition = kEdition;  ///< earlier ones are read, too: see earlier_editions.h
};

std::vector<std::uint8_t> written(const RecordingHeader& header);
std::vector<std::uint8_t> written(const Path& path);
/// Nothing when it is none: then the reader is bad.
RecordingHeader read_header(ByteReader& in);
Path read_path(ByteReader& in);

}  // namespace drover::gateway
