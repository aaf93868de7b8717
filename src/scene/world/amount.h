// How much the scene may hold: it is kept in memory, and walked through many times a second.
#pragma once

#include <cstddef>
#include <optional>

#include "scene/message/refusal.h"
#include "scene/world/object.h"

namespace drover::scene {

struct Amount {
  std::size_t objects = 0;
  std::size_t constraints = 0;  ///< single ones, of all sets
  std::size_t shapes = 0;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t texts = 0;  ///< of the store: one for each object and each set
  std::size_t bytes = 0;  ///< as text in the store, at most
  friend bool operator==(const Amount&, const Amount&) = default;
};

/// The last two are what the store takes (store/scene_store.h), less the room for its own words.
inline constexpr Amount kMost{
    1000, 1000, 10'000, 100'000, 300'000, 2000 - 1, (std::size_t{16} << 20) - 4096};

Amount amount_of(const Object& object);
/// What an object that is there grows by when it gets these shapes.
Amount amount_of_shapes(const Object& object);
/// Regions are shapes, too.
Amount amount_of(const Constraints& set);
Amount sum(const Amount& a, const Amount& b);
/// Of what is there, without a part of it.
Amount without(const Amount& all, const Amount& part);

/// Refused with the numbers when `there` and `more` are beyond kMost.
std::optional<Refusal> too_much(const Amount& there, const Amount& more);

}  // namespace drover::scene
