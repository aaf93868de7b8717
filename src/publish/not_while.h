// When nothing that may be in the robot's way can be taken out of it: it would drive on by itself.
#pragma once

#include <string_view>

#include "drover/snapshot.h"

namespace drover::publish {

/// Why not, in words that last for ever; empty: nobody moves it. `task`: there is one, though
/// somebody else may have stopped it just now.
constexpr std::string_view not_while(Owner owner, bool task) {
  if (task || owner == Owner::task) return "not while a task runs: cancel it first";
  if (owner == Owner::manual)
    return "not while a person drives it, or the heading is looked for: cancel it first";
  if (owner == Owner::cmd_vel) return "not while cmd_vel moves the robot: end it first";
  if (owner == Owner::joint_command)
    return "not while joint commands move the robot: end them first";
  return {};
}
inline constexpr std::string_view kNotWhileItBegins =
    "not while the robot is about to be moved: cancel that first, or try again";

}  // namespace drover::publish
