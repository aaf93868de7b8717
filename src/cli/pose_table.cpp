#include "cli/pose_table.h"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace drover::cli {
namespace {

void add(std::string& line, double value, int decimals) {
  line += ',';
  if (!std::isfinite(value)) return;
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  line += text;
}

/// In quotes, which a comma needs; quotes in it are doubled.
void add(std::string& line, std::string_view text) {
  line += ',';
  if (text.empty()) return;
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c == '\n' || c == '\r' ? ' ' : c;
  }
  line += '"';
}

}  // namespace

bool RowTimes::is_due(Time now) {
  if (now < next_) return false;
  next_ += apart_ * ((now - next_) / apart_ + 1);
  return true;
}

std::string pose_head() {
  return "time_s,x_m,y_m,yaw_rad,vx_mps,wz_radps,position_sigma_m,predicted_error_m,"
         "error_bound_m,yaw_sigma_rad,latitude_deg,longitude_deg,quality,notice,reason\n";
}

std::string pose_line(double time_s, const PoseRow& row) {
  // Before there is a place or a heading, numbers stand for nothing.
  const bool placed = std::isfinite(row.pose.position_sigma_m);
  const bool turned = std::isfinite(row.pose.yaw_sigma_rad);
  char time[40];
  std::snprintf(time, sizeof time, "%.3f", time_s);
  std::string line = time;
  add(line, placed ? row.pose.x_m : kAbsent, 4);
  add(line, placed ? row.pose.y_m : kAbsent, 4);
  add(line, turned ? row.pose.yaw_rad : kAbsent, 5);
  add(line, row.pose.vx_mps, 4);
  add(line, row.pose.wz_radps, 4);
  add(line, row.pose.position_sigma_m, 4);
  add(line, row.predicted_error_m, 4);
  add(line, row.error_bound_m, 4);
  add(line, row.pose.yaw_sigma_rad, 5);
  add(line, placed ? row.latitude_deg : kAbsent, 10);
  add(line, placed ? row.longitude_deg : kAbsent, 10);
  line += ',';
  if (row.quality) line += std::to_string(static_cast<int>(*row.quality));
  add(line, row.notice);
  add(line, row.reason);
  return line + "\n";
}

}  // namespace drover::cli
