// AimRT messages through protoc itself, with .proto files written here from the document's field
// numbers: nothing of the product's own encoder or .proto files is asked.
#pragma once

#include <string>
#include <string_view>

namespace drover::test {

/// Text of a message of aimrt.protocols.sensor ("JointState"), as `protoc --decode` prints it.
/// Throws std::runtime_error when protoc refuses the bytes.
std::string protoc_decoded(std::string_view type, std::string_view message);

/// The bytes that `protoc --encode` makes of such a text.
std::string protoc_encoded(std::string_view type, std::string_view text);

/// The message in an AimRT packet with the content type "pb" and no context. Throws
/// std::runtime_error when it is another packet.
std::string message_of_packet(std::string_view packet);

}  // namespace drover::test
