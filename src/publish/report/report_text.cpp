#include "publish/report/report_text.h"

#include "publish/line_json.h"
#include "publish/names.h"

namespace drover::publish {
namespace {

using json::JsonText;

std::string_view result_of(const TaskReport& report) {
  if (!report.begun) return "not started";
  switch (report.how) {
    case TaskEnded::How::success: return "success";
    case TaskEnded::How::cancelled: return "cancelled";
    case TaskEnded::How::failed: return "failed";
  }
  return "failed";
}

std::string_view quality_word(std::size_t quality) {
  return quality == kNotHeard ? "not heard" : word(static_cast<FixQuality>(quality));
}

void put_qualities(JsonText& out, const TaskReport& report) {
  out.key("quality").open('[');
  for (std::size_t i = 0; i < kQualities; ++i) {
    const double way_m = report.way_by_quality_m[i];
    if (way_m <= 0) continue;
    out.open('{').key("quality").text(quality_word(i));
    number_or_null(out, "way_m", way_m, 2);
    number_or_null(out, "share", way_m / report.way_m, 4);
    out.close('}');
  }
  out.close(']');
}

void put_pauses(JsonText& out, const TaskReport& report) {
  out.key("pauses").open('[');
  for (const ReportPause& pause : report.pauses) {
    out.open('{').key("reason").text(pause.reason);
    number_or_null(out, "after_s", pause.after_s, 1);
    number_or_null(out, "lasted_s", pause.lasted_s, 1);
    number_or_null(out, "x_m", pause.x_m, 3);
    number_or_null(out, "y_m", pause.y_m, 3);
    number_or_null(out, "way_m", pause.way_m, 2);
    out.close('}');
  }
  out.close(']').key("pauses_left_out").integer(static_cast<std::int64_t>(report.pauses_left_out));
}

std::string summary_text(const TaskReport& report) {
  JsonText out;
  out.open('{').key("track").text(report.track).key("target_id").integer(report.target_id);
  number_or_null(out, "asked_mps", report.asked_mps, 3);
  number_or_null(out, "began_unix_s", to_s(report.began_since_1970), 1);
  out.key("result").text(result_of(report)).key("reason").text(report.reason);
  number_or_null(out, "time_s", report.time_s, 1);
  number_or_null(out, "moving_s", report.moving_s, 1);
  number_or_null(out, "paused_s", report.paused_s, 1);
  number_or_null(out, "way_m", report.way_m, 2);
  number_or_null(out, "left_m", report.left_m, 2);
  out.key("cross_track").open('{');
  number_or_null(out, "from_way_m", report.joined_m, 2);
  number_or_null(out, "rms_m", report.rms_m, 4);
  number_or_null(out, "p95_m", report.p95_m, 4);
  number_or_null(out, "max_m", report.worst_m, 4);
  out.close('}').key("speed").open('{');
  number_or_null(out, "mean_mps", report.mean_mps, 3);
  number_or_null(out, "max_mps", report.fastest_mps, 3);
  out.close('}').key("error_bound").open('{');
  number_or_null(out, "max_m", report.worst_bound_m, 3);
  number_or_null(out, "max_moving_m", report.worst_bound_moving_m, 3);
  out.close('}');
  put_qualities(out, report);
  put_pauses(out, report);
  return out.close('}').take();
}

void put_cell(JsonText& out, double value, int decimals) {
  std::isfinite(value) ? out.number(value, decimals) : out.null();
}

std::string line_text(const TaskReport& report) {
  JsonText out;
  out.open('{').key("track").open('[');
  for (const PathPoint& point : report.line) {
    out.open('[');
    put_cell(out, point.x_m, 3);
    put_cell(out, point.y_m, 3);
    out.close(']');
  }
  out.close(']').key("columns").open('[');
  for (const auto* column :
       {"x_m", "y_m", "way_m", "cross_track_m", "speed_mps", "error_bound_m", "quality"})
    out.text(column);
  out.close(']').key("driven").open('[');
  for (const ReportSample& sample : report.samples) {
    out.open('[');
    put_cell(out, sample.x_m, 3);
    put_cell(out, sample.y_m, 3);
    put_cell(out, sample.way_m, 2);
    put_cell(out, sample.cross_track_m, 3);
    put_cell(out, sample.speed_mps, 3);
    put_cell(out, sample.error_bound_m, 3);
    out.text(quality_word(sample.quality)).close(']');
  }
  return out.close(']').close('}').take();
}

}  // namespace

store::ReportTexts report_texts(const TaskReport& report) {
  return {summary_text(report), line_text(report)};
}

}  // namespace drover::publish
