// The third document's messages as JSON: every field, in its order.
#include <cmath>
#include <concepts>
#include <span>

#include "publish/scene/fields.h"
#include "publish/scene/messages.h"

namespace drover::publish {
namespace scene_json {
namespace {

template <class Value>
void write(json::JsonText& out, const Value& value) {
  if constexpr (std::floating_point<Value>) {
    // Without a point it would be read as the integer 0, which has no sign.
    const bool negative_zero = value == 0 && std::signbit(value);
    negative_zero ? out.spelled_number("-0.0") : out.number(value);
  } else if constexpr (std::integral<Value>) {
    out.integer(static_cast<std::int64_t>(value));
  } else if constexpr (std::same_as<Value, std::string>) {
    out.text(value);
  } else if constexpr (requires { fields(value, [](const Name&, auto&&) {}); }) {
    out.open('{');
    fields(value, [&out](const Name& name, auto&& field) {
      out.key(name.spellings[0]);
      write(out, field);
    });
    out.close('}');
  } else {
    out.open('[');
    for (const auto& element : value) write(out, element);
    out.close(']');
  }
}

}  // namespace
}  // namespace scene_json

void write_scene(json::JsonText& out, const scene::CollisionObject& object) {
  scene_json::write(out, object);
}

void write_scene(json::JsonText& out, const scene::Constraints& constraints) {
  scene_json::write(out, constraints);
}

}  // namespace drover::publish
