#include "publish/report/task_recorder.h"

#include <algorithm>
#include <cmath>

namespace drover::publish {
namespace {

constexpr double kStands_mps = 0.01;
constexpr double kRounding_m = 1e-6;
constexpr double kOnTrack_m =
    0.2;  // the tracker's own word for it: before, a corridor means nothing
constexpr double kClass_m = 0.001;
constexpr std::size_t kClasses = 3000;
constexpr Duration kLongestGap = std::chrono::seconds(1);  // nobody saw what was driven meanwhile
constexpr std::size_t kMostLine = 2000;
constexpr double kLineSpacing_m = 0.05;

std::uint8_t quality_of(const Snapshot& seen) {
  if (seen.gnss.health != SourceState::fresh) return kNotHeard;
  return std::min(static_cast<std::uint8_t>(seen.gnss.position.quality), kNotHeard);
}

void raise(double& worst, double value) {
  if (std::isfinite(value) && !(value <= worst)) worst = value;
}

/// For a drawing: as far apart as the length allows.
std::vector<PathPoint> drawn_line(const Path& path) {
  double length_m = 0;
  const auto apart_m = [](const PathPoint& a, const PathPoint& b) {
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  };
  for (std::size_t i = 1; i < path.points.size(); ++i)
    length_m += apart_m(path.points[i - 1], path.points[i]);
  const double spacing_m = std::max(kLineSpacing_m, length_m / (kMostLine - 2));
  std::vector<PathPoint> line;
  for (const PathPoint& point : path.points) {
    const bool end = &point == &path.points.front() || &point == &path.points.back();
    if (end || apart_m(line.back(), point) >= spacing_m) line.push_back(point);
  }
  return line;
}

}  // namespace

TaskRecorder::TaskRecorder(const GivenTask& task, Time accepted, Duration since_1970)
    : accepted_(accepted), classes_m_(kClasses + 1) {
  report_.track = task.track;
  report_.target_id = task.target_id;
  report_.asked_mps = task.asked_mps;
  report_.began_since_1970 = since_1970;
  if (task.path != nullptr) report_.line = drawn_line(*task.path);
}

void TaskRecorder::take(const Snapshot& seen) {
  const bool of_it = seen.nav.status == NavStatus::run && seen.time >= accepted_;
  if (!of_it || (last_ && seen.time <= last_->time)) return;
  drive(seen);
  look_at_pause(seen);
  sample(seen);
  report_.left_m = seen.nav.distance_left_m;
}

/// The way is what the robot itself says it drove: a pose that trembles at rest drives nothing.
void TaskRecorder::drive(const Snapshot& seen) {
  const double now_mps = std::isfinite(seen.pose.vx_mps) ? std::abs(seen.pose.vx_mps) : 0.0;
  const Last before = last_.value_or(Last{seen.time, now_mps});
  const double dt_s = to_s(std::min(seen.time - before.time, kLongestGap));
  const double mean_mps = 0.5 * (before.speed_mps + now_mps);
  const bool moves = mean_mps > kStands_mps;
  const double way_m = moves ? mean_mps * dt_s : 0.0;
  report_.way_m += way_m;
  report_.moving_s += moves ? dt_s : 0.0;
  report_.way_by_quality_m[quality_of(seen)] += way_m;
  raise(report_.fastest_mps, now_mps);
  compare_with_track(std::abs(seen.nav.cross_track_m), way_m);
  look_at_bound(seen, now_mps > kStands_mps);
  last_ = Last{seen.time, now_mps};
}

void TaskRecorder::compare_with_track(double cross_track_m, double way_m) {
  if (!std::isfinite(cross_track_m)) return;
  if (!std::isfinite(report_.joined_m)) {
    if (cross_track_m > kOnTrack_m) return;
    report_.joined_m = report_.way_m;
  }
  judged_m_ += way_m;
  squares_m3_ += cross_track_m * cross_track_m * way_m;
  const auto which = static_cast<std::size_t>(std::min(cross_track_m / kClass_m, 1.0 * kClasses));
  classes_m_[which] += way_m;
  if (way_m > 0) raise(report_.worst_m, cross_track_m);
}

void TaskRecorder::look_at_bound(const Snapshot& seen, bool moves) {
  raise(report_.worst_bound_m, seen.nav.error_bound_m);
  if (moves) raise(report_.worst_bound_moving_m, seen.nav.error_bound_m);
}

void TaskRecorder::look_at_pause(const Snapshot& seen) {
  wait_until(seen.time);
  if (!seen.nav.paused) {
    paused_since_.reset();
    return;
  }
  if (!paused_since_) {
    paused_since_ = waited_until_ = seen.time;
    pause_kept_ = report_.pauses.size() < kMostPauses;
    if (pause_kept_) {
      report_.pauses.push_back(
          {"", to_s(seen.time - accepted_), 0, seen.pose.x_m, seen.pose.y_m, report_.way_m});
    } else {
      ++report_.pauses_left_out;
    }
  }
  if (!pause_kept_) return;
  ReportPause& pause = report_.pauses.back();
  if (pause.reason.empty() && !seen.why.empty()) pause.reason = seen.why[0].view();
}

/// A pause lasts until it is seen to be over, or until its task ends.
void TaskRecorder::wait_until(Time now) {
  if (!paused_since_ || now <= waited_until_) return;
  report_.paused_s += to_s(now - waited_until_);
  waited_until_ = now;
  if (pause_kept_) report_.pauses.back().lasted_s = to_s(now - *paused_since_);
}

void TaskRecorder::sample(const Snapshot& seen) {
  newest_ = {seen.pose.x_m,    seen.pose.y_m,          report_.way_m,   seen.nav.cross_track_m,
             last_->speed_mps, seen.nav.error_bound_m, quality_of(seen)};
  auto& samples = report_.samples;
  if (!samples.empty() && report_.way_m - samples.back().way_m < spacing_m_ - kRounding_m) return;
  samples.push_back(newest_);
  if (samples.size() >= kMostSamples) thin();
}

/// However near the one before it lies: the way is drawn to its end.
void TaskRecorder::add_last_place() {
  auto& samples = report_.samples;
  if (samples.empty()) return;
  const ReportSample& last = samples.back();
  const bool same =
      last.way_m == newest_.way_m && last.x_m == newest_.x_m && last.y_m == newest_.y_m;
  if (!same) samples.push_back(newest_);
}

void TaskRecorder::thin() {
  auto& samples = report_.samples;
  for (std::size_t i = 0; 2 * i < samples.size(); ++i) samples[i] = samples[2 * i];
  samples.resize((samples.size() + 1) / 2);
  // What comes is not to lie denser than what is there.
  spacing_m_ = report_.way_m / static_cast<double>(samples.size());
}

/// The upper end of its class.
double TaskRecorder::percentile_m(double share) const {
  double way_m = 0;
  for (std::size_t i = 0; i < kClasses; ++i) {
    way_m += classes_m_[i];
    if (way_m >= share * judged_m_)
      return std::min(static_cast<double>(i + 1) * kClass_m, report_.worst_m);
  }
  return report_.worst_m;
}

TaskReport TaskRecorder::end(Time ended, bool begun, TaskEnded::How how, std::string_view reason) {
  report_.begun = begun;
  report_.how = how;
  report_.reason = reason;
  report_.time_s = to_s(ended - accepted_);
  wait_until(ended);
  add_last_place();
  if (report_.moving_s > 0) report_.mean_mps = report_.way_m / report_.moving_s;
  if (judged_m_ > 0) {
    report_.rms_m = std::sqrt(squares_m3_ / judged_m_);
    report_.p95_m = percentile_m(0.95);
  }
  return std::move(report_);
}

}  // namespace drover::publish
