#include "gateway/recording/encoder.h"

#include "gateway/recording/field_values.h"
#include "gateway/recording/text.h"

namespace drover::gateway {

std::span<const std::uint8_t> RecordEncoder::input(const Input& input) {
  ByteWriter out(buffer_);
  out.byte(kind_of(input));
  write_input(input, before_, out);
  before_ = input.time;
  return out.good() ? out.written() : std::span<const std::uint8_t>();
}

std::span<const std::uint8_t> RecordEncoder::output(const Gateway& gateway) {
  const CycleOutput& cycle = gateway.output();
  ByteWriter out(buffer_);
  out.byte(static_cast<std::uint8_t>(RecordKind::output));
  FieldChanges changes(fields_, out);
  visit_fields(changes, gateway);
  changes.end();
  out.number(cycle.engine.events.size());
  for (const auto& event : cycle.engine.events) out.text(text_of(event));
  for (std::size_t bus = 0; bus < gateway.bus_count(); ++bus) {
    out.number(cycle.frames[bus].size());
    for (const auto& frame : cycle.frames[bus]) write_frame(frame, out);
  }
  for (const auto& stream : cycle.streams) {
    out.blob(stream.bytes);
    out.number(stream.reopen_baud);
  }
  return out.good() ? out.written() : std::span<const std::uint8_t>();
}

std::vector<FieldName> field_names(const Gateway& gateway) {
  std::vector<FieldName> names;
  FieldNames visitor(names);
  visit_fields(visitor, gateway);
  for (auto& field : names)  // elements of a list have no name of their own
    if (field.name.ends_with('.')) field.name.pop_back();
  return names;
}

}  // namespace drover::gateway
