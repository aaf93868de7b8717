// A task's report as a person reads it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json/located_json.h"

namespace drover::cli {

/// A line of the report.
using Figure = std::pair<std::string_view, std::string>;  // label and words
/// All but its pauses, of droverd's answer to `report`.
std::vector<Figure> figures(const json::Node& answer);
/// One screen, of droverd's answer to `report`.
std::string show_report(const json::Node& answer);
/// A line each, the newest first.
std::string show_reports(const json::Node& answer);

}  // namespace drover::cli
