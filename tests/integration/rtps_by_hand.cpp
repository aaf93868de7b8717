#include "integration/rtps_by_hand.h"

#include <algorithm>
#include <initializer_list>

namespace drover::test::rtps {
namespace {

using Entity = std::array<std::uint8_t, 4>;
constexpr Entity kNobodyNamed{0, 0, 0, 0};
constexpr Entity kParticipant{0, 0, 1, 0xc1};
constexpr Entity kParticipantWriter{0, 1, 0, 0xc2};
constexpr Entity kParticipantReader{0, 1, 0, 0xc7};
constexpr Entity kPublicationWriter{0, 0, 3, 0xc2};
constexpr Entity kPublicationReader{0, 0, 3, 0xc7};

void add(Bytes& to, std::span<const std::uint8_t> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}
void add16(Bytes& to, std::size_t value) {
  to.push_back(static_cast<std::uint8_t>(value));
  to.push_back(static_cast<std::uint8_t>(value >> 8));
}
void add32(Bytes& to, std::uint32_t value) {
  add16(to, value & 0xffff);
  add16(to, value >> 16);
}

/// Little endian, as each submessage says in its flags.
void submessage(Bytes& to, std::uint8_t kind, std::uint8_t flags, const Bytes& body) {
  to.push_back(kind);
  to.push_back(flags);
  add16(to, body.size());
  add(to, body);
}

void parameter(Bytes& to, std::uint16_t id, const Bytes& value) {
  add16(to, id);
  add16(to, value.size());
  add(to, value);
}

Bytes text(std::string_view what) {
  Bytes out;
  add32(out, static_cast<std::uint32_t>(what.size() + 1));
  out.insert(out.end(), what.begin(), what.end());
  out.push_back(0);
  out.resize((out.size() + 3) / 4 * 4);
  return out;
}

Bytes numbers(std::initializer_list<std::uint32_t> values) {
  Bytes out;
  for (const std::uint32_t value : values) add32(out, value);
  return out;
}

Bytes guid(const Guid& of, const Entity& entity) {
  Bytes out(of.begin(), of.begin() + 12);
  add(out, entity);
  return out;
}

Bytes loopback(std::uint32_t port) {
  Bytes out = numbers({1, port, 0, 0, 0});
  add(out, std::array<std::uint8_t, 4>{127, 0, 0, 1});
  return out;
}

/// RTPS 2.1, of a vendor who is not ours.
Bytes head(const Guid& writer) {
  Bytes out{'R', 'T', 'P', 'S', 2, 1, 1, 15};
  add(out, std::span(writer).first(12));
  return out;
}

void add_data(Bytes& to, const Entity& reader, const Entity& writer, std::uint32_t number,
              std::span<const std::uint8_t> payload) {
  Bytes body;
  add16(body, 0);
  add16(body, 16);  // from here to the payload
  add(body, reader);
  add(body, writer);
  add(body, numbers({0, number}));
  add(body, payload);
  submessage(to, 0x15, 0x05, body);
}

/// All that a reliable writer has is its sample 1.
void add_heartbeat(Bytes& to, const Entity& reader, const Entity& writer, std::uint32_t count) {
  Bytes body;
  add(body, reader);
  add(body, writer);
  add(body, numbers({0, 1, 0, 1, count}));
  submessage(to, 0x07, 0x03, body);
}

Bytes parameters() {
  return {0, 3, 0, 0};
}

}  // namespace

Bytes participant(const Guid& writer, int domain) {
  const auto port = static_cast<std::uint32_t>(7400 + 250 * domain + 10 + 2 * 20);
  Bytes payload = parameters();
  parameter(payload, 0x15, {2, 1, 0, 0});
  parameter(payload, 0x16, {1, 15, 0, 0});
  parameter(payload, 0x50, guid(writer, kParticipant));
  parameter(payload, 0x31, loopback(port + 1));  // samples
  parameter(payload, 0x32, loopback(port));      // what DDS says of itself
  parameter(payload, 0x02, numbers({100, 0}));   // lives so long
  parameter(payload, 0x58, numbers({0xc3f}));    // has what every participant has
  parameter(payload, 0x01, {});
  Bytes out = head(writer);
  add_data(out, kParticipantReader, kParticipantWriter, 1, payload);
  return out;
}

Bytes publication(const Guid& writer, std::string_view topic, std::string_view type) {
  Bytes payload = parameters();
  parameter(payload, 0x50, guid(writer, kParticipant));
  parameter(payload, 0x5a, Bytes(writer.begin(), writer.end()));
  parameter(payload, 0x05, text(topic));
  parameter(payload, 0x07, text(type));
  parameter(payload, 0x1a, numbers({1, 0, 0}));  // best effort
  parameter(payload, 0x01, {});
  Bytes out = head(writer);
  add_heartbeat(out, kPublicationReader, kPublicationWriter, 1);
  add_data(out, kPublicationReader, kPublicationWriter, 1, payload);
  add_heartbeat(out, kPublicationReader, kPublicationWriter, 2);
  return out;
}

Bytes data(const Guid& writer, std::uint32_t number, std::span<const std::uint8_t> sample) {
  Bytes out = head(writer);
  Entity entity{};
  std::copy(writer.begin() + 12, writer.end(), entity.begin());
  add_data(out, kNobodyNamed, entity, number, sample);
  return out;
}

}  // namespace drover::test::rtps
