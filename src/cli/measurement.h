// A driver's measurement as a line of text or one JSON object: names of values end in their unit.
#pragma once

#include <string>
#include <string_view>

#include "drover/fixed_text.h"
#include "drover/measurement.h"

namespace drover::cli {

/// Where in the file a measurement comes from.
struct Place {
  std::string_view key;  ///< "byte", "line" or "t_s"
  double value = 0;
  int decimals = 0;
  std::string who;  ///< "node 3" where there are several devices; else empty
};

/// "axis_motion", "gnss_position", ...; empty for an empty measurement.
std::string_view kind_of(const Measurement& measurement);

/// `words`: what its device says of it.
/// "     12  gnss_position  latitude 42.833333333 deg  ..."; absent values are "-".
std::string measurement_text(const Measurement& measurement, const Reason& words,
                             const Place& place);
/// The same as one JSON object; absent values are null.
std::string measurement_json(const Measurement& measurement, const Reason& words,
                             const Place& place);

}  // namespace drover::cli
