// AimRT messages through protoc and libprotobuf themselves, with .proto files written here from the
// document's field numbers: nothing of the product's own encoder or .proto files is asked.
#pragma once

#include <string>
#include <string_view>

namespace drover::test {

// `type` is a message of aimrt.protocols.sensor: of the document ("JointState"), or of AimRT 1.x
// when it ends in Array. What the tool refuses throws std::runtime_error.

/// Text of a message, as `protoc --decode` prints it.
std::string protoc_decoded(std::string_view type, std::string_view message);

/// The bytes that `protoc --encode` makes of such a text.
std::string protoc_encoded(std::string_view type, std::string_view text);

/// The JSON that AimRT writes for a message, and the bytes of what it reads in a JSON.
std::string protobuf_json(std::string_view type, std::string_view message);
std::string protobuf_of_json(std::string_view type, std::string_view json);

/// The message in an AimRT packet with the content type "pb" or "json" and no context. Throws
/// std::runtime_error when it is another packet.
std::string message_of_packet(std::string_view packet);

}  // namespace drover::test
