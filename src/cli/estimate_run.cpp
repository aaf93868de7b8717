#include "cli/estimate_run.h"

#include <cmath>
#include <limits>

#include "cli/estimate_log.h"
#include "cli/pose_table.h"
#include "engine/base/kinematics.h"
#include "engine/estimate/estimator.h"

namespace drover::cli {
namespace {

/// A log may begin at any time, also before zero; the engine counts from a start.
constexpr Duration kBegin = std::chrono::seconds(100);

class Run final {
 public:
  Run(const EstimateRun& run, std::ostream& out)
      : run_(run),
        out_(out),
        base_(engine::kinematics_of(run.config.base)),
        estimator_(run.config.estimate, run.config.base),
        step_(from_s(1 / run.config.tick_Hz)),
        rows_(run.rate_Hz) {
    if (run.origin) estimator_.set_origin(*run.origin);
  }

  void take(const LogRow& row) {
    if (!begun()) begin(row.received);
    while (now_ + step_ < shifted(row.received)) step();
    if (row.motion) give(*row.motion, row);
    if (row.imu) give(*row.imu, row);
    if (row.position) {
      take_origin(*row.position);
      quality_ = row.position->quality;
      give(*row.position, row);
    }
    if (row.heading) give(*row.heading, row);
  }
  void finish() {
    if (begun()) step();
  }
  std::uint64_t poses() const { return poses_; }

 private:
  bool begun() const { return now_ != kNever; }
  void begin(Time first) {
    shift_ = kBegin - first.time_since_epoch();
    now_ = shifted(first);
    rows_.begin(now_);
  }
  Time shifted(Time time) const { return time + shift_; }

  template <class Value>
  void give(const Value& value, const LogRow& row) {
    estimator_.on_measurement({shifted(row.time), shifted(row.received), value});
  }
  /// As this base would tell it: by its joints, or by a twist.
  void give(const LoggedMotion& motion, const LogRow& row) {
    const auto& config = run_.config.base;
    if (engine::takes_twist(base_)) {
      BodyMotion body;
      body.twist = motion.by_rims ? twist_by_rims(motion) : Twist{motion.first, motion.second};
      body.known = true;
      body.standing = is_zero(body.twist);
      return give(body, row);
    }
    const engine::Learned configured{config.yaw_slip_factor};
    const auto joints = engine::setpoints(base_, {motion.first, motion.second}, configured,
                                          std::numeric_limits<double>::max());
    const auto give_side = [&](const auto& side, double rim_mps) {
      for (const AxisId axis : side) {
        AxisMotion joint;
        joint.axis = axis;
        joint.velocity_radps = motion.by_rims ? engine::joint_radps(base_, rim_mps) : joints[axis];
        give(joint, row);
      }
    };
    give_side(config.left, motion.first);
    give_side(config.right, motion.second);
  }
  Twist twist_by_rims(const LoggedMotion& motion) const {
    engine::JointVelocities edges;
    (void)edges.push_back(motion.first);
    (void)edges.push_back(motion.second);
    return engine::twist_of_edges(base_, edges);
  }
  void take_origin(const GnssPosition& position) {
    if (estimator_.has_origin() || position.quality == FixQuality::none) return;
    const double altitude_m = position.altitude_msl_m;
    estimator_.set_origin({position.latitude_deg, position.longitude_deg,
                           std::isfinite(altitude_m) ? altitude_m : 0.0});
  }

  void step() {
    now_ += step_;
    const engine::Estimate& e = estimator_.step(now_);
    if (!rows_.is_due(now_)) return;
    PoseRow row;
    row.pose = e.pose;
    if (!e.has_position) row.pose.position_sigma_m = kAbsent;
    if (!e.has_heading) row.pose.yaw_sigma_rad = kAbsent;
    row.predicted_error_m = e.predicted_error_m;
    row.error_bound_m = e.error_bound_m;
    const GeodeticPoint antenna = estimator_.antenna_geodetic(e.pose);
    row.latitude_deg = antenna.latitude_deg;
    row.longitude_deg = antenna.longitude_deg;
    row.quality = quality_;
    row.notice = e.notice.view();
    row.reason = e.reason.view();
    out_ << pose_line(to_s(now_ - shift_), row);
    ++poses_;
  }

  const EstimateRun& run_;
  std::ostream& out_;
  engine::Kinematics base_;
  engine::Estimator estimator_;
  Duration step_;
  Duration shift_{};
  Time now_ = kNever;
  RowTimes rows_;
  std::optional<FixQuality> quality_;
  std::uint64_t poses_ = 0;
};

}  // namespace

EstimateOutcome estimate(std::istream& log, const EstimateRun& run, std::ostream& out) {
  EstimateOutcome outcome;
  LogReader reader;
  Run estimator(run, out);
  out << pose_head();
  for (std::string line; std::getline(log, line);) {
    if (!reader.has_head()) {
      if (const auto wrong = reader.read_head(line)) outcome.problem = wrong->text();
    } else if (const auto row = reader.read_row(line); !row.ok()) {
      outcome.problem = row.error().text();
    } else if (*row) {
      ++outcome.rows;
      estimator.take(**row);
    }
    if (!outcome.problem.empty()) break;
  }
  estimator.finish();
  outcome.poses = estimator.poses();
  if (!outcome.problem.empty()) return outcome;
  if (log.bad()) {
    outcome.problem = "cannot be read";
  } else if (outcome.rows == 0) {
    outcome.problem = "there is no row in it";
  }
  return outcome;
}

}  // namespace drover::cli
