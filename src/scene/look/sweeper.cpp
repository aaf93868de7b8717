#include "scene/look/sweeper.h"

#include <algorithm>

#include "drover/angle.h"

namespace drover::scene {
namespace {

/// A name that is longer leaves no room for what is said of it.
constexpr std::size_t kShownName = 80;

bool is_earlier(const FreeWay& a, const FreeWay& b) {
  if (!a.blocked || !b.blocked) return a.blocked;
  return std::pair(a.free_m, a.free_rad) < std::pair(b.free_m, b.free_rad);
}

std::string shown_name(const std::string& name) {
  return std::string(FixedText<kShownName>(name).view());
}

}  // namespace

WayEnd Sweeper::sweep(std::span<const Step> steps) const {
  WayEnd first{first_contact(around_.field, footprint_, steps), WayEnd::Of::object};
  const auto take_earlier = [&first](const FreeWay& way, WayEnd::Of of) {
    if (is_earlier(way, first.way)) first = {way, of};
  };
  // What is not there costs nothing; whether the way is one of numbers was looked at already.
  if (around_.keep_out.size() > 0)
    take_earlier(first_contact(around_.keep_out, footprint_, steps), WayEnd::Of::keep_out);
  if (!around_.keep_in.empty())
    take_earlier(first_exit(around_.keep_in, footprint_, steps), WayEnd::Of::keep_in);
  return first;
}

std::string Sweeper::name(const WayEnd& end) const {
  const std::size_t i = end.way.object;
  if (i == kNoObject) return "a way that cannot be judged";
  if (end.of == WayEnd::Of::object) return around_.field.name(i);
  if (end.of == WayEnd::Of::keep_out) return "keep-out " + around_.keep_out.name(i);
  const bool known = i < around_.keep_in_names.size();
  return "the fence of " + (known ? around_.keep_in_names[i] : std::string("a zone"));
}

Reason in_the_turn(const std::string& name, const char* is, double turn_rad, bool left) {
  const std::string shown = shown_name(name);
  Reason words;
  words.format("%s %s in the way of the turn to the %s, after %.0f deg", shown.c_str(), is,
               left ? "left" : "right", to_deg(turn_rad));
  return words;
}

Reason in_the_way(const std::string& name, const char* where, double way_m) {
  const std::string shown = shown_name(name);
  Reason words;
  words.format("%s is in the way, %.2f m %s", shown.c_str(), way_m, where);
  return words;
}

Reason is_there(const std::string& name) {
  const std::string shown = shown_name(name);
  Reason words;
  words.format("%s is where the robot is, or within its margin", shown.c_str());
  return words;
}

}  // namespace drover::scene
