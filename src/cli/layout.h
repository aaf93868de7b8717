// How values of droverd's answers become columns of text: absent ones are "-", never 0.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

/// A member; a node without a value where there is none.
const json::Node& at(const json::Node& node, std::string_view key);
/// A text as people may see it, a flag as "yes" or "no", anything else as nothing.
std::string text(const json::Node& node);
/// One number by a printf format such as "%.2f m"; "-" when it is absent.
std::string quantity(const json::Node& node, const char* format);
/// "3.25 m", and from 10 km on "102.4 km".
std::string distance(const json::Node& node);
/// "speed 0.50 m/s", or "speed -" when it is absent.
std::string labelled(std::string_view label, const json::Node& node, const char* format);
/// Seconds since 1970 by a strftime format, in UTC; empty when they are absent.
std::string date(const json::Node& unix_s, const char* format);
bool yes(const json::Node& node);
/// A number; 0 when it is absent.
double value_of(const json::Node& node);
/// How long a list is; 0 for anything else.
std::size_t count(const json::Node& list);
/// Of a list; a node without a value where it has none.
const json::Node& entry(const json::Node& list, std::size_t i);
/// Appends one line with its label in a column of its own.
void line(std::string& out, std::string_view label, const std::string& value);
/// Pads to `width` columns, counting UTF-8 characters.
std::string padded(std::string value, std::size_t width);

}  // namespace drover::cli
