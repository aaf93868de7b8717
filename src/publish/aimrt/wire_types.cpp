#include "publish/aimrt/wire_types.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <cstdint>
#include <string>

namespace drover::publish::aimrt {

namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

struct Field;

/// A message's fields by their numbers, from 1 on.
struct Fields {
  const Field* first = nullptr;
  int count = 0;
};

struct Field {
  const char* name = "";
  const char* kind = "";
  WireFormatLite::WireType wire_type = WireFormatLite::WIRETYPE_VARINT;
  bool repeated = false;
  Fields inner{};  ///< of a message
};

constexpr auto kVarint = WireFormatLite::WIRETYPE_VARINT;
constexpr auto kDouble = WireFormatLite::WIRETYPE_FIXED64;
constexpr auto kBytes = WireFormatLite::WIRETYPE_LENGTH_DELIMITED;

// As in common.proto and sensor.proto.
constexpr Field kHeader[] = {
    {"time_stamp", "uint64", kVarint},
    {"frame_id", "string", kBytes},
    {"sequence_num", "uint64", kVarint},
};
constexpr Field kJoint[] = {
    {"name", "string", kBytes},       {"position", "double", kDouble},
    {"velocity", "double", kDouble},  {"effort", "double", kDouble},
    {"stiffness", "double", kDouble}, {"damping", "double", kDouble},
};
constexpr Field kCommand[] = {
    {"header", "message", kBytes, false, {kHeader, 3}},
    {"joints", "message", kBytes, true, {kJoint, 6}},
};

/// Of the message at `place`, and of those in it.
Reason problem_in(std::string_view bytes, const Fields& fields, const std::string& place) {
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                      static_cast<int>(bytes.size()));
  int entries = 0;
  for (std::uint32_t tag = in.ReadTag(); tag != 0; tag = in.ReadTag()) {
    const int number = WireFormatLite::GetTagFieldNumber(tag);
    if (number < 1 || number > fields.count) {
      if (!WireFormatLite::SkipField(&in, tag)) return {};
      continue;
    }
    const Field& field = fields.first[number - 1];
    if (WireFormatLite::GetTagWireType(tag) != field.wire_type)
      return Reason(place + field.name + " is no " + field.kind);
    if (field.inner.count == 0) {
      if (!WireFormatLite::SkipField(&in, tag)) return {};
      continue;
    }
    std::uint32_t length = 0;
    if (!in.ReadVarint32(&length)) return {};
    const auto inner = bytes.substr(static_cast<std::size_t>(in.CurrentPosition()), length);
    if (!in.Skip(static_cast<int>(length))) return {};
    const auto index = field.repeated ? "[" + std::to_string(entries++) + "]" : std::string();
    const Reason why = problem_in(inner, field.inner, place + field.name + index + ".");
    if (!why.empty()) return why;
  }
  return {};
}

}  // namespace

Reason wire_type_problem(std::string_view bytes) {
  return problem_in(bytes, {kCommand, 2}, "");
}

}  // namespace drover::publish::aimrt
