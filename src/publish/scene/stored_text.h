// Objects and constraints as texts that the store keeps: the origin of their map, and messages.
#pragma once

#include <string>
#include <string_view>

#include "drover/result.h"
#include "scene/keeper/keeper.h"
#include "scene/message/refusal.h"

namespace drover::publish {

/// A line with the origin, and one with the list of messages. Read again it is the same to the bit.
std::string stored_text(const scene::StoredObject& object);
std::string stored_text(const scene::StoredSet& set);

/// Each message is found valid again.
Result<scene::StoredObject, scene::Refusal> read_stored_object(std::string_view text);
Result<scene::StoredSet, scene::Refusal> read_stored_set(std::string_view text);

}  // namespace drover::publish
