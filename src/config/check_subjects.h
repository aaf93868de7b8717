// The checks that span several keys, by subject; checks.cpp says in which order.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "config/fields.h"
#include "config/findings.h"

namespace drover::config {

inline constexpr std::array<std::string_view, kLineCount> kLineKeys{"estop", "bumper", "zone_far",
                                                                    "zone_near"};

// Names that refer to each other, and what two may not share.
void check_drive_names(Findings& found);  ///< fills in the bus of each drive
void check_lines(Findings& found);
void check_ports(Findings& found);

/// The wheels; fills in their axes and what holds the base.
void check_base(const BaseNames& base, Findings& found);

// Values that contradict each other.
void check_limits(Findings& found);
void check_broker(Findings& found);
void check_channel(Findings& found);

// The devices: what only their drivers know.
/// Fills in the registers; a map is looked for below `folder`.
void check_battery(const std::string& folder, Findings& found);
/// The driver places each byte in time by the pace at which the line is really opened.
void follow_baud_rates(Findings& found);
void check_drivers(Findings& found);

/// What a person may accept by name.
void check_accepted(Findings& found);
void warn_of_risks(Findings& found);

}  // namespace drover::config
