#include "cli/show_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "cli/layout.h"

namespace drover::cli {
namespace {

using json::Node;

constexpr std::size_t kPausesShown = 8;  // of a screen
constexpr std::size_t kTrackColumns = 24;

/// A member in centimetres: "1.3 cm".
std::string centimetres(const Node& object, std::string_view key) {
  const auto value_m = at(object, key).number();
  if (!value_m) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f cm", 100 * *value_m);
  return text;
}

std::string minutes(const Node& seconds) {
  const auto value_s = seconds.number();
  if (!value_s) return "-";
  char text[48];
  if (*value_s < 120) {
    std::snprintf(text, sizeof text, "%.1f s", *value_s);
  } else {
    std::snprintf(text, sizeof text, "%.0f min %02.0f s", std::floor(*value_s / 60),
                  std::fmod(std::floor(*value_s), 60));
  }
  return text;
}

std::string result_words(const Node& report) {
  std::string words = text(at(report, "result"));
  const auto reason = text(at(report, "reason"));
  return reason.empty() ? words : words + ": " + reason;
}

std::string cross_track_words(const Node& report) {
  const Node& cross = at(report, "cross_track");
  std::string words = "rms " + centimetres(cross, "rms_m") + "  95 % " +
                      centimetres(cross, "p95_m") + "  max " + centimetres(cross, "max_m");
  // The way that the robot took to its track is not judged.
  if (value_of(at(cross, "from_way_m")) > 0.05)
    words += quantity(at(cross, "from_way_m"), "  (from %.1f m on)");
  return words;
}

std::string quality_words(const Node& report) {
  std::string words;
  const Node& all = at(report, "quality");
  for (std::size_t i = 0; i < count(all); ++i) {
    const Node& one = entry(all, i);
    char share[32];
    std::snprintf(share, sizeof share, " %.1f %%", 100 * value_of(at(one, "share")));
    words += (words.empty() ? "" : "  ") + text(at(one, "quality")) + share;
  }
  return words.empty() ? "-" : words;
}

void show_pauses(std::string& out, const Node& report) {
  const Node& pauses = at(report, "pauses");
  const std::size_t all =
      count(pauses) + static_cast<std::size_t>(value_of(at(report, "pauses_left_out")));
  if (all == 0) return line(out, "pauses", "none");
  line(out, "pauses", std::to_string(all) + ", " + minutes(at(report, "paused_s")) + " in all");
  for (std::size_t i = 0; i < std::min(count(pauses), kPausesShown); ++i) {
    const Node& pause = entry(pauses, i);
    line(out, "",
         quantity(at(pause, "lasted_s"), "%6.1f s") + quantity(at(pause, "way_m"), "  at %.1f m") +
             quantity(at(pause, "x_m"), "  x %.2f") + quantity(at(pause, "y_m"), " y %.2f m  ") +
             text(at(pause, "reason")));
  }
  if (all > kPausesShown)
    line(out, "", "and " + std::to_string(all - kPausesShown) + " more: drover report --json");
}

}  // namespace

std::string date_text(const Node& unix_s) {
  const auto value_s = unix_s.number();
  if (!value_s) return "-";
  const auto seconds = static_cast<std::time_t>(*value_s);
  std::tm utc{};
  if (::gmtime_r(&seconds, &utc) == nullptr) return "-";
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

std::string show_report(const Node& answer) {
  const Node& report = at(answer, "report");
  std::string out;
  line(out, "report",
       quantity(at(answer, "number"), "%.0f") + "  " + date_text(at(report, "began_unix_s")));
  line(out, "track",
       "\"" + text(at(report, "track")) + "\" to point " +
           quantity(at(report, "target_id"), "%.0f") +
           quantity(at(report, "asked_mps"), ", asked %.2f m/s"));
  line(out, "result", result_words(report));
  line(out, "way",
       quantity(at(report, "way_m"), "%.1f m") + " in " + minutes(at(report, "time_s")) +
           quantity(at(report, "left_m"), ", %.2f m left"));
  line(out, "beside", cross_track_words(report));
  const Node& speed = at(report, "speed");
  line(out, "speed",
       quantity(at(speed, "mean_mps"), "mean %.2f m/s") +
           quantity(at(speed, "max_mps"), "  max %.2f m/s"));
  line(out, "gnss", quality_words(report));
  const Node& bound = at(report, "error_bound");
  line(out, "bound",
       centimetres(bound, "max_moving_m") + " at most while it moved, " +
           centimetres(bound, "max_m") + " in all");
  show_pauses(out, report);
  return out;
}

std::string show_reports(const Node& answer) {
  const Node& reports = at(answer, "reports");
  if (count(reports) == 0) return "no report: no task has ended yet\n";
  std::string out;
  for (std::size_t i = 0; i < count(reports); ++i) {
    const Node& one = entry(reports, i);
    const Node& report = at(one, "report");
    out += quantity(at(one, "number"), "%5.0f  ") + date_text(at(report, "began_unix_s")) + "  " +
           padded(text(at(report, "track")), kTrackColumns) +
           quantity(at(report, "way_m"), "%8.1f m") + "  rms " +
           padded(centimetres(at(report, "cross_track"), "rms_m"), 9) + text(at(report, "result")) +
           "\n";
  }
  return out;
}

}  // namespace drover::cli
