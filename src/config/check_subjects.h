// The checks that span several keys, by subject; checks.cpp says in which order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/fields.h"
#include "config/findings.h"

namespace drover::config {

/// Of a serial line that says nothing.
inline constexpr int kUsualBaud = 115200;

// The tables: names that refer to each other, and what two may not share.
void check_links(Findings& found);    ///< fills in wires and usual speeds
void check_devices(Findings& found);  ///< fills in kinds and links
void check_buses(Findings& found);    ///< drives that do not go together on one
/// Of receivers, inertial sensors and batteries; fills in their roles and antennas.
void check_roles(Findings& found);
engine::SensorList sensors_of(const DroverConfig& config, SlotKind kind);
void check_joints(Findings& found);  ///< fills in the joints
/// Fills in their axes: those of the base come first.
void number_joints(const std::vector<JointGroup>& groups, Findings& found);
void check_lines(Findings& found);  ///< fills in the outputs' chip
void check_use_of_links(Findings& found);
/// nullptr, and told at `path`: there is none of that name.
const LinkConfig* find_link(const std::string& name, const std::string& path, Findings& found);
/// "a CAN bus", "a serial line", ...
std::string_view words(Wire wire);

/// The wheels, or the device that takes the twist; fills in their axes, what kind the base is and
/// what holds it.
void check_base(const GroupNames& groups, Findings& found);
/// Joints outside the base: fills in their rules.
void check_groups(const GroupNames& groups, Findings& found);
bool has_joint(const JointGroup& group, const std::string& joint);
/// One of them has it.
bool has_joint(const std::vector<JointGroup>& groups, const std::string& joint);

// Values that contradict each other.
void check_limits(Findings& found);
void check_paths(Findings& found);
void check_broker(Findings& found);
void check_channel(Findings& found);
/// Inputs that whoever reaches the robot's networks could use.
void check_ros2(Findings& found);
void warn_of_deaf_arms(Findings& found);
/// What the robot covers, and its frames; turns the footprint counter-clockwise.
void check_scene(Findings& found);
void warn_of_short_look(Findings& found);
/// Scanners, and the field that they look at.
void check_scanners(Findings& found);
void warn_of_short_field(Findings& found);

// The devices: what only their drivers know.
/// Fills in the registers; a map is looked for below `folder`.
void check_batteries(const std::string& folder, Findings& found);
/// The driver places each byte in time by the pace at which the line is really opened.
void follow_baud_rates(Findings& found);
void check_drivers(Findings& found);
/// limits.max_speed_mps, or what the chassis clamps to when that is less.
double fastest_mps(const DroverConfig& config);
void warn_of_slow_chassis(Findings& found);

/// What a person may accept by name.
void check_accepted(Findings& found);
void warn_of_risks(Findings& found);

}  // namespace drover::config
