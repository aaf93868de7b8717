// A task's report as a person reads it.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// One screen, of droverd's answer to `report`.
std::string show_report(const json::Node& answer);
/// A line each, the newest first.
std::string show_reports(const json::Node& answer);

/// "2026-03-01 14:05 UTC"; "-" when it is absent.
std::string date_text(const json::Node& unix_s);

}  // namespace drover::cli
