#include "cli/estimate_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "text/suggestion.h"
#include "text/trimmed.h"

namespace drover::cli {
namespace {

constexpr std::array<std::string_view, 25> kLogColumns = {
    "time_s",          "received_s",       "left_rim_mps",      "right_rim_mps",
    "vx_mps",          "wz_radps",         "gyro_x_radps",      "gyro_y_radps",
    "gyro_z_radps",    "accel_x_mps2",     "accel_y_mps2",      "accel_z_mps2",
    "latitude_deg",    "longitude_deg",    "altitude_m",        "quality",
    "sigma_east_m",    "sigma_north_m",    "correction_age_s",  "heading_deg",
    "receiver_mps",    "command_left_mps", "command_right_mps", "command_vx_mps",
    "command_wz_radps"};
/// A value of the first is nothing without the second in its row.
constexpr std::array<std::pair<std::string_view, std::string_view>, 23> kTogether = {
    {{"left_rim_mps", "right_rim_mps"},
     {"right_rim_mps", "left_rim_mps"},
     {"vx_mps", "wz_radps"},
     {"command_left_mps", "command_right_mps"},
     {"command_right_mps", "command_left_mps"},
     {"command_vx_mps", "command_wz_radps"},
     {"command_wz_radps", "command_vx_mps"},
     {"wz_radps", "vx_mps"},
     {"gyro_x_radps", "gyro_z_radps"},
     {"gyro_y_radps", "gyro_z_radps"},
     {"accel_x_mps2", "gyro_z_radps"},
     {"accel_x_mps2", "accel_y_mps2"},
     {"accel_y_mps2", "accel_z_mps2"},
     {"accel_z_mps2", "accel_x_mps2"},
     {"latitude_deg", "longitude_deg"},
     {"longitude_deg", "latitude_deg"},
     {"latitude_deg", "quality"},
     {"quality", "latitude_deg"},
     {"altitude_m", "latitude_deg"},
     {"sigma_east_m", "sigma_north_m"},
     {"sigma_north_m", "sigma_east_m"},
     {"sigma_east_m", "latitude_deg"},
     {"correction_age_s", "latitude_deg"}}};
// Unix time is within; two of them apart have room in 64 bits, as nanoseconds.
constexpr double kLongest_s = 4e9;
constexpr int kMostQuality = 8;  // of GGA
constexpr Duration kLongestGap = std::chrono::hours(1);

bool says_nothing(std::string_view line) {
  line = text::trimmed(line);
  return line.empty() || line.front() == '#';
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(text::trimmed(line.substr(0, comma)));
    if (comma == line.npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

Time time_of(double seconds) {
  return Time{from_s(seconds)};
}

}  // namespace

std::string LogError::text() const {
  std::string text = "line " + std::to_string(line);
  if (column > 0) text += ", column " + std::to_string(column) + " (" + name + ")";
  return text + ": " + message;
}

LogError LogReader::error(std::size_t column, std::string message) const {
  return {line_, column + 1, column < columns_.size() ? columns_[column] : "", std::move(message)};
}

std::size_t LogReader::column_of(std::string_view name) const {
  return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), name) -
                                  columns_.begin());
}

std::optional<double> LogReader::value(std::string_view name) const {
  const std::size_t column = column_of(name);
  return column < cells_.size() ? cells_[column] : std::nullopt;
}

std::optional<LogError> LogReader::read_head(std::string_view line) {
  ++line_;
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // spreadsheets begin with it
  if (says_nothing(line)) return std::nullopt;
  std::vector<std::string> known(kLogColumns.begin(), kLogColumns.end());
  for (const auto name : split(line)) {
    columns_.emplace_back(name);
    const std::size_t column = columns_.size() - 1;
    if (column_of(name) != column) return error(column, "this column is there twice");
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto meant = text::did_you_mean(std::string(name), known);
    return error(column, "there is no such column" + (meant.empty() ? "" : "; " + meant));
  }
  if (column_of("time_s") == columns_.size())
    return LogError{line_, 0, "", "there is no column time_s"};
  if (column_of("vx_mps") < columns_.size() && column_of("left_rim_mps") < columns_.size())
    return error(column_of("vx_mps"), "the motion of the base is told twice: by its rims, too");
  if (column_of("command_vx_mps") < columns_.size() &&
      column_of("command_left_mps") < columns_.size())
    return error(column_of("command_vx_mps"), "the command is told twice: by its rims, too");
  cells_.assign(columns_.size(), 0.0);  // as if a row had them all
  for (const auto& [name, other] : kTogether)
    if (auto wrong = needs(name, other)) return wrong;
  return std::nullopt;
}

std::optional<LogError> LogReader::needs(std::string_view name, std::string_view other) const {
  if (!value(name) || value(other)) return std::nullopt;
  return error(column_of(name), "it needs " + std::string(other) + " beside it");
}

std::optional<LogError> LogReader::read_cells(std::string_view line) {
  const auto cells = split(line);
  if (cells.size() != columns_.size())
    return LogError{line_, 0, "",
                    std::to_string(cells.size()) + " cells, and there are " +
                        std::to_string(columns_.size()) + " columns"};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells_[i].reset();
    if (cells[i].empty()) continue;
    double value = 0;
    const auto* end = cells[i].data() + cells[i].size();
    const auto read = std::from_chars(cells[i].data(), end, value);
    if (read.ec != std::errc() || read.ptr != end)
      return error(i, "\"" + std::string(cells[i].substr(0, 40)) + "\" is no number");
    if (!std::isfinite(value))
      return error(i, "not a finite number; what is not known is an empty cell");
    cells_[i] = value;
  }
  return std::nullopt;
}

Result<std::optional<LogRow>, LogError> LogReader::read_row(std::string_view line) {
  ++line_;
  if (says_nothing(line)) return std::optional<LogRow>{};
  if (auto wrong = read_cells(line)) return *wrong;
  if (auto wrong = check_groups()) return *wrong;
  LogRow row;
  if (auto wrong = check_values()) return *wrong;
  fill(row);
  const bool told = value("received_s").has_value();
  const std::size_t ordered_by = column_of(told ? "received_s" : "time_s");
  if (told && row.received < row.time)
    return error(ordered_by, "it was received before it was true");
  if (last_ != kNever && row.received < last_)
    return error(ordered_by,
                 "rows are in the order in which they were received, and this one is "
                 "earlier than the one before it");
  if (last_ != kNever && row.received - last_ > kLongestGap)
    return error(ordered_by, "more than an hour after the row before it: these are two logs");
  last_ = row.received;
  return std::optional<LogRow>{row};
}

std::optional<LogError> LogReader::check_groups() const {
  if (!value("time_s")) return error(column_of("time_s"), "is missing");
  for (const auto& [name, other] : kTogether)
    if (auto wrong = needs(name, other)) return wrong;
  return std::nullopt;
}

std::optional<LogError> LogReader::check_values() const {
  const auto within = [&](std::string_view name, double least,
                          double most) -> std::optional<LogError> {
    const auto is = value(name);
    if (!is || (*is >= least && *is <= most)) return std::nullopt;
    char text[80];
    std::snprintf(text, sizeof text, "%g is not within %g and %g", *is, least, most);
    return error(column_of(name), text);
  };
  struct Range {
    std::string_view name;
    double least;
    double most;
  };
  constexpr Range kRanges[] = {{"time_s", -kLongest_s, kLongest_s},
                               {"received_s", -kLongest_s, kLongest_s},
                               {"latitude_deg", -90, 90},
                               {"longitude_deg", -360, 360},
                               {"heading_deg", -360, 360},
                               {"quality", 0, kMostQuality},
                               {"sigma_east_m", 0, 1e6},
                               {"sigma_north_m", 0, 1e6},
                               {"correction_age_s", 0, 1e6},
                               {"receiver_mps", 0, 1e3}};
  for (const auto& [name, least, most] : kRanges)
    if (auto wrong = within(name, least, most)) return wrong;
  if (const auto quality = value("quality"); quality && *quality != std::floor(*quality))
    return error(column_of("quality"), "is a whole number, as in GGA: 4 is RTK fixed, 5 float");
  return std::nullopt;
}

void LogReader::fill(LogRow& row) const {
  row.time = time_of(*value("time_s"));
  row.received = value("received_s") ? time_of(*value("received_s")) : row.time;
  if (const auto left = value("left_rim_mps"))
    row.motion = LoggedMotion{true, *left, *value("right_rim_mps")};
  if (const auto vx = value("vx_mps")) row.motion = LoggedMotion{false, *vx, *value("wz_radps")};
  row.receiver_mps = value("receiver_mps");
  if (const auto left = value("command_left_mps"))
    row.command = LoggedMotion{true, *left, *value("command_right_mps")};
  if (const auto vx = value("command_vx_mps"))
    row.command = LoggedMotion{false, *vx, *value("command_wz_radps")};
  if (const auto gyro_z = value("gyro_z_radps")) {
    ImuSample imu;
    imu.angular_velocity_radps = {value("gyro_x_radps").value_or(0),
                                  value("gyro_y_radps").value_or(0), *gyro_z};
    constexpr double kGravity_mps2 = 9.81;  // level where nobody tells
    imu.acceleration_mps2 = {value("accel_x_mps2").value_or(0), value("accel_y_mps2").value_or(0),
                             value("accel_z_mps2").value_or(kGravity_mps2)};
    row.imu = imu;
  }
  if (const auto latitude = value("latitude_deg")) {
    GnssPosition position;
    position.latitude_deg = *latitude;
    position.longitude_deg = *value("longitude_deg");
    position.altitude_msl_m = value("altitude_m").value_or(kAbsent);
    position.undulation_m = 0;  // the log's altitude is above the ellipsoid
    position.quality = static_cast<FixQuality>(*value("quality"));
    position.sigma_east_m = value("sigma_east_m").value_or(kAbsent);
    position.sigma_north_m = value("sigma_north_m").value_or(kAbsent);
    position.correction_age_s = value("correction_age_s").value_or(kAbsent);
    row.position = position;
  }
  if (const auto heading = value("heading_deg"))
    row.heading = GnssHeading{*heading < 0 ? *heading + 360 : *heading};
}

}  // namespace drover::cli
