// The devices in droverd's status as text for people, and what of the status each is.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

struct DeviceView {
  std::string_view name;                    ///< of the command
  std::string_view device;                  ///< what it shows, for people
  std::span<const std::string_view> parts;  ///< members of the status that it shows
  /// Several lines; the status has its rates already.
  std::string (*show)(const json::Node& status);
};

std::span<const DeviceView> device_views();

/// Why there is nothing to show; empty when there is.
std::string missing(const DeviceView& view, const json::Node& status);

}  // namespace drover::cli
