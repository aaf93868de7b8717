// Rates from the counters of two answers of droverd.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// Adds to `status` what `before`, an earlier status, tells about pace: `rate_Hz` to each device
/// and drive, `received_Hz`, `sent_Hz`, `dropped_Hz` and `refused_Hz` to each link. Null where
/// nothing can be said.
void add_rates(json::Node& status, const json::Node& before);

/// The value as JSON text in one line.
std::string json_line(const json::Node& node);

}  // namespace drover::cli
