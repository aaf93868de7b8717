// The base's wheels are drives, each on one side.
#include <algorithm>

#include "config/check_subjects.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

engine::HoldBy hold_by(std::string_view word) {
  if (word == "brake") return engine::HoldBy::brake;
  return word == "worm_gear" ? engine::HoldBy::worm_gear : engine::HoldBy::level_ground_only;
}

void side(const std::string& path, const std::vector<std::string>& joints,
          FixedVector<AxisId, 8>& into, Findings& found) {
  const auto known = collect(found.config().drives, [](const auto& d) { return d.joint; });
  for (const auto& joint : joints) {
    const auto it = std::find(known.begin(), known.end(), joint);
    if (it == known.end()) {
      found.add(path, "no drive has the joint \"" + joint + "\"", text::did_you_mean(joint, known));
      continue;
    }
    const auto axis = static_cast<AxisId>(it - known.begin());
    if (std::find(into.begin(), into.end(), axis) != into.end())
      found.add(path, "the joint \"" + joint + "\" is there twice");
    else
      (void)into.push_back(axis);  // too many are told by the reader
  }
}

void both_sides(const BaseNames& base, Findings& found) {
  for (const auto& joint : base.left)
    if (std::find(base.right.begin(), base.right.end(), joint) != base.right.end())
      found.add("base.right", "the joint \"" + joint + "\" is on both sides");
}

/// Its faults, its silence and its stop would be nobody's.
void wheels_only(const BaseNames& base, Findings& found) {
  if (found.has_problem("base")) return;
  const auto among = [](const std::vector<std::string>& side, const std::string& joint) {
    return std::find(side.begin(), side.end(), joint) != side.end();
  };
  for (std::size_t i = 0; i < found.config().drives.size(); ++i) {
    const auto& joint = found.config().drives[i].joint;
    if (joint.empty() || among(base.left, joint) || among(base.right, joint)) continue;
    found.add(
        item("drives", i) + ".joint",
        "\"" + joint + "\" is no wheel of the base: joints outside the base are not supported yet",
        "name it in base.left or base.right, or leave the drive out");
  }
}

}  // namespace

void check_base(const BaseNames& base, Findings& found) {
  auto& resolved = found.config().engine.base;
  side("base.left", base.left, resolved.left, found);
  side("base.right", base.right, resolved.right, found);
  both_sides(base, found);
  wheels_only(base, found);
  resolved.hold = hold_by(base.hold);
}

}  // namespace drover::config
