// AimRT's MQTT payload: content type, context pairs, and then the message.
//
// AimRT 1.x documentation, mqtt plugin: one byte length and the content type ("pb" or "json"); one
// byte number of context pairs; each pair as key and value, each with two bytes length, little
// endian; the rest is the message.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drover/result.h"

namespace drover::publish::aimrt {

/// How the message is written. Both stand on the same topic: only the packet tells them apart.
enum class Content : std::uint8_t { pb, json };
std::string_view spelling(Content content);

/// Views into the payload that was decoded.
struct Packet {
  std::string_view content_type;
  std::string_view context;  ///< the pairs as they came, already walked once; Drover uses none
  std::string_view message;
};

enum class PacketError : std::uint8_t {
  no_content_type,
  no_context,
  bad_context,
  bare_json,  ///< the message is there, and nothing before it
};
std::string_view text(PacketError error);

/// A packet without context around a message.
std::string encode_packet(std::string_view message, Content content = Content::pb);
/// Any bytes; a length is believed only when so many bytes are there.
Result<Packet, PacketError> decode_packet(std::string_view payload);

}  // namespace drover::publish::aimrt
