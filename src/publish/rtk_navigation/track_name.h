// Which texts may name a track.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace drover::publish {

/// Of any name, also one that is looked up. Control characters would forge lines in logs and
/// listings.
std::optional<std::string> name_problem(std::string_view name, std::size_t max_bytes);

/// Of a new name. One that was stored before this rule can still be driven and deleted.
std::optional<std::string> new_name_problem(std::string_view name);

}  // namespace drover::publish
