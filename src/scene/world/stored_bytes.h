// How large what is kept may become as text in the store, without writing it.
//
// Upper bounds, of the JSON that publish/scene writes of it: each number as long as the longest,
// each byte of a name escaped. They add up: an object that is appended to needs the sum.
#pragma once

#include <cstddef>

#include "scene/world/object.h"

namespace drover::scene {

/// Of an object without its shapes, with what the store says of the text.
std::size_t stored_bytes_of_head(const Object& object);
/// Of its shapes and their poses, in as many messages as they need.
std::size_t stored_bytes_of_shapes(const Object& object);
std::size_t stored_bytes(const Constraints& set);

}  // namespace drover::scene
