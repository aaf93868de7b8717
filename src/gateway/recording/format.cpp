#include "gateway/recording/format.h"

namespace drover::gateway {

std::vector<std::uint8_t> written(const RecordingHeader& header) {
  std::size_t room = 1024 + header.configuration.size() + header.register_map.size();
  for (const auto& field : header.fields) room += field.name.size() + 8;
  std::vector<std::uint8_t> bytes(room);
  ByteWriter out(bytes);
  for (const char c : kRecordingBegins) out.byte(static_cast<std::uint8_t>(c));
  out.byte(static_cast<std::uint8_t>('0' + header.edition));
  out.byte('\n');
  out.text(header.version);
  out.text(header.configuration);
  out.text(header.register_map);
  out.raw(header.mathematics);
  out.number(header.fields.size());
  for (const auto& field : header.fields) {
    out.byte(static_cast<std::uint8_t>(field.kind));
    out.text(field.name);
  }
  bytes.resize(out.written().size());
  return bytes;
}

RecordingHeader read_header(ByteReader& in) {
  RecordingHeader header;
  for (const char c : kRecordingBegins)
    if (in.byte() != static_cast<std::uint8_t>(c)) in.fail();
  header.edition = static_cast<std::uint8_t>(in.byte() - '0');
  if (header.edition < 1 || header.edition > kEdition || in.byte() != '\n') in.fail();
  header.version = in.text();
  header.configuration = in.text();
  header.register_map = in.text();
  header.mathematics = in.raw();
  const auto count = in.below(kMaxFields + 1);
  for (std::uint64_t i = 0; i < count && in.good(); ++i) {
    const auto kind = static_cast<FieldKind>(in.byte());
    if (kind != FieldKind::whole && kind != FieldKind::real && kind != FieldKind::text) in.fail();
    header.fields.push_back({kind, std::string(in.text())});
  }
  return header;
}

std::vector<std::uint8_t> written(const Path& path) {
  std::vector<std::uint8_t> bytes(64 + path.name.size() + 17 * path.points.size());
  ByteWriter out(bytes);
  out.byte(static_cast<std::uint8_t>(RecordKind::path));
  out.number(path.number);
  out.text(path.name);
  out.number(path.points.size());
  for (const auto& point : path.points) {
    out.real(point.x_m);
    out.real(point.y_m);
  }
  if (!path.backwards.empty()) {
    out.byte(path.either ? 1 : 0);
    for (const std::uint8_t flag : path.backwards) out.byte(flag != 0 ? 1 : 0);
  }
  bytes.resize(out.written().size());
  return bytes;
}

Path read_path(ByteReader& in) {
  constexpr std::size_t kPointBytes = 16;
  Path path;
  path.number = in.number();
  path.name = in.text();
  const auto count = in.number();
  if (count > in.left().size() / kPointBytes) in.fail();
  for (std::uint64_t i = 0; i < count && in.good(); ++i) {
    const double x_m = in.real();
    path.points.push_back({x_m, in.real()});
  }
  if (!in.good() || in.left().empty()) return path;
  path.either = in.below(2) != 0;
  for (std::uint64_t i = 1; i < count && in.good(); ++i)
    path.backwards.push_back(static_cast<std::uint8_t>(in.below(2)));
  return path;
}

}  // namespace drover::gateway
