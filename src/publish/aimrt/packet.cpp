#include "publish/aimrt/packet.h"

#include <cstddef>
#include <optional>

namespace drover::publish::aimrt {

namespace {

/// Takes bytes off the front; nothing when there are too few.
std::optional<std::string_view> take(std::string_view& rest, std::size_t count) {
  if (count > rest.size()) return std::nullopt;
  const auto taken = rest.substr(0, count);
  rest.remove_prefix(count);
  return taken;
}

std::optional<std::size_t> take_length(std::string_view& rest, std::size_t bytes) {
  const auto taken = take(rest, bytes);
  if (!taken) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    length |= std::size_t{static_cast<unsigned char>((*taken)[i])} << (8 * i);
  return length;
}

std::optional<std::string_view> take_text(std::string_view& rest, std::size_t length_bytes) {
  const auto length = take_length(rest, length_bytes);
  return length ? take(rest, *length) : std::nullopt;
}

}  // namespace

std::string_view text(PacketError error) {
  switch (error) {
    case PacketError::no_content_type: return "the packet ends inside its content type";
    case PacketError::no_context: return "the packet has no number of context pairs";
    case PacketError::bad_context: return "the packet ends inside its context";
    case PacketError::bare_json:
      return "JSON without AimRT's packet: the bytes 04 6a 73 6f 6e 00 are missing before it";
  }
  return "";
}

std::string_view spelling(Content content) {
  return content == Content::pb ? "pb" : "json";
}

std::string encode_packet(std::string_view message, Content content) {
  const auto type = spelling(content);
  std::string packet;
  packet.reserve(2 + type.size() + message.size());
  packet += static_cast<char>(type.size());
  packet += type;
  packet += '\0';
  packet += message;
  return packet;
}

Result<Packet, PacketError> decode_packet(std::string_view payload) {
  // As a length it would be a content type of 123 bytes, which nobody has.
  if (payload.substr(0, 1) == "{") return PacketError::bare_json;
  auto rest = payload;
  Packet packet;
  const auto content_type = take_text(rest, 1);
  if (!content_type) return PacketError::no_content_type;
  packet.content_type = *content_type;
  const auto pairs = take_length(rest, 1);
  if (!pairs) return PacketError::no_context;
  const auto from_context = rest;
  for (std::size_t i = 0; i < *pairs; ++i) {
    const bool key = take_text(rest, 2).has_value();
    if (!key || !take_text(rest, 2)) return PacketError::bad_context;
  }
  packet.context = from_context.substr(0, from_context.size() - rest.size());
  packet.message = rest;
  return packet;
}

}  // namespace drover::publish::aimrt
