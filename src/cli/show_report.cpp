#include "cli/show_report.h"

#include <algorithm>
#include <cmath>

#include "cli/layout.h"
#include "text/number.h"

namespace drover::cli {
namespace {

using json::Node;

constexpr std::size_t kPausesShown = 8;  // of a screen
constexpr std::size_t kTrackColumns = 24;

/// A member in centimetres: "1.3 cm".
std::string centimetres(const Node& object, std::string_view key) {
  const auto value_m = at(object, key).number();
  return value_m ? text::formed("%.1f cm", 100 * *value_m) : "-";
}

std::string minutes(const Node& seconds) {
  const auto value_s = seconds.number();
  if (!value_s) return "-";
  if (*value_s < 120) return text::formed("%.1f s", *value_s);
  return text::formed("%.0f min ", std::floor(*value_s / 60)) +
         text::formed("%02.0f s", std::fmod(std::floor(*value_s), 60));
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
    words += (words.empty() ? "" : "  ") + text(at(one, "quality")) +
             text::formed(" %.1f %%", 100 * value_of(at(one, "share")));
  }
  return words.empty() ? "-" : words;
}

std::string date_words(const Node& report) {
  const auto words = date(at(report, "began_unix_s"), "%Y-%m-%d %H:%M UTC");
  return words.empty() ? "-" : words;
}

void show_pauses(std::string& out, const Node& answer) {
  const Node& report = at(answer, "report");
  const Node& pauses = at(report, "pauses");
  const auto left_out = static_cast<std::size_t>(value_of(at(report, "pauses_left_out")));
  const std::size_t all = count(pauses) + left_out;
  if (all == 0) return line(out, "pauses", "none");
  line(out, "pauses", std::to_string(all) + ", " + minutes(at(report, "paused_s")) + " in all");
  for (std::size_t i = 0; i < std::min(count(pauses), kPausesShown); ++i) {
    const Node& pause = entry(pauses, i);
    line(out, "",
         quantity(at(pause, "lasted_s"), "%6.1f s") + quantity(at(pause, "way_m"), "  at %.1f m") +
             quantity(at(pause, "x_m"), "  x %.2f") + quantity(at(pause, "y_m"), " y %.2f m  ") +
             text(at(pause, "reason")));
  }
  if (count(pauses) > kPausesShown)
    line(out, "",
         "and " + std::to_string(count(pauses) - kPausesShown) + " more: drover report " +
             quantity(at(answer, "number"), "%.0f") + " --json");
  if (left_out > 0) line(out, "", "and " + std::to_string(left_out) + " that were not kept");
}

}  // namespace

std::vector<Figure> figures(const Node& answer) {
  const Node& report = at(answer, "report");
  const Node& speed = at(report, "speed");
  const Node& bound = at(report, "error_bound");
  return {
      {"report", quantity(at(answer, "number"), "%.0f") + "  " + date_words(report)},
      {"track", "\"" + text(at(report, "track")) + "\" to point " +
                    quantity(at(report, "target_id"), "%.0f") +
                    quantity(at(report, "asked_mps"), ", asked %.2f m/s")},
      {"result", result_words(report)},
      {"way",
       quantity(at(report, "way_m"), "%.1f m") + " in " + minutes(at(report, "time_s")) +
           (at(report, "left_m").number() ? quantity(at(report, "left_m"), ", %.2f m left") : "")},
      {"beside", cross_track_words(report)},
      {"speed", quantity(at(speed, "mean_mps"), "mean %.2f m/s") +
                    quantity(at(speed, "max_mps"), "  max %.2f m/s")},
      {"gnss", quality_words(report)},
      {"bound", centimetres(bound, "max_moving_m") + " at most while it moved, " +
                    centimetres(bound, "max_m") + " in all"}};
}

std::string show_report(const Node& answer) {
  std::string out;
  for (const auto& [label, words] : figures(answer)) line(out, label, words);
  show_pauses(out, answer);
  return out;
}

std::string show_reports(const Node& answer) {
  const Node& reports = at(answer, "reports");
  std::string out = text(at(answer, "problem"));
  if (!out.empty()) out += "\n";
  if (count(reports) == 0 && out.empty()) return "no report: no task has ended yet\n";
  for (std::size_t i = 0; i < count(reports); ++i) {
    const Node& one = entry(reports, i);
    const Node& report = at(one, "report");
    out += quantity(at(one, "number"), "%5.0f  ") + date_words(report) + "  " +
           padded(text(at(report, "track")), kTrackColumns) +
           quantity(at(report, "way_m"), "%8.1f m") + "  rms " +
           padded(centimetres(at(report, "cross_track"), "rms_m"), 9) + text(at(report, "result")) +
           "\n";
  }
  return out;
}

}  // namespace drover::cli
