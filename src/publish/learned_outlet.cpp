#include "publish/learned_outlet.h"

#include <cmath>

#include "drover/angle.h"
#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/line_json.h"

namespace drover::publish {
namespace {

// A disk is written to when it is worth it.
constexpr Duration kEachDriving = std::chrono::minutes(1);
constexpr Duration kEachResting = std::chrono::seconds(5);
// Of a value against its sigma, and of a sigma against what it was.
constexpr double kOtherValue = 0.5;
constexpr double kOtherSigma = 0.7;

bool differs(const LearnedValue& now, const LearnedValue& kept) {
  if (now.known() != kept.known()) return true;
  if (!now.known()) return false;
  return std::abs(now.value - kept.value) > kOtherValue * now.sigma ||
         now.sigma < kOtherSigma * kept.sigma;
}

bool differs(const LearnedValues& now, const LearnedValues& kept) {
  bool other = now.receiver != kept.receiver;
  each_learned_of_both(now, kept, [&other](const LearnedValue& value, const LearnedValue& before) {
    other = differs(value, before) || other;
  });
  return other;
}

/// One line of the answer: a key of the configuration, or the name of what has none, with what it
/// should be and 95 % of the doubt.
struct ShownValue {
  const char* name;
  const char* unit;
  double configured;  ///< absent: there is no such key
  double fits;
  double interval;
  const char* used;  ///< what is done with it
};

void write(json::JsonText& out, const ShownValue& value, int decimals) {
  out.open('{').key("name").text(value.name).key("unit").text(value.unit);
  out.key("configured");
  if (std::isfinite(value.configured)) {
    out.number(value.configured, decimals);
  } else {
    out.null();
  }
  out.key("fits").number(value.fits, decimals).key("interval").number(value.interval, decimals);
  out.key("used").text(value.used).close('}');
}

constexpr const char* kMadeUp = "made up for";
constexpr const char* kInBound = "only in the error bound: correct the configuration";
constexpr const char* kAsConfigured = "as configured";
constexpr double kTwoSigma = 2;

/// As far as its digits are shown: nothing was learned yet, or nothing else.
bool is_as_configured(const ShownValue& shown, int decimals) {
  return std::abs(shown.fits - shown.configured) * std::pow(10, decimals) < 0.5;
}

void write_values(json::JsonText& out, const LearnedValues& learned, const LearnedBeside& beside) {
  const auto add = [&out](const LearnedValue& value, ShownValue shown, int decimals, double scale) {
    if (!value.known()) return;
    shown.interval = kTwoSigma * value.sigma * scale;
    if (is_as_configured(shown, decimals)) shown.used = kAsConfigured;
    write(out, shown, decimals);
  };
  const double offset_deg = beside.heading_baseline_offset_deg;
  add(learned.mounting_rad,
      {"heading_baseline_offset_deg", "deg", offset_deg,
       offset_deg - to_deg(learned.mounting_rad.value), 0, kMadeUp},
      2, to_deg(1));
  add(learned.antenna_ahead_m,
      {"antenna_x_m", "m", beside.antenna_x_m, beside.antenna_x_m + learned.antenna_ahead_m.value,
       0, kInBound},
      3, 1);
  add(learned.antenna_left_m,
      {"antenna_y_m", "m", beside.antenna_y_m, beside.antenna_y_m + learned.antenna_left_m.value, 0,
       kInBound},
      3, 1);
  add(learned.late_s, {"positions late", "s", kAbsent, learned.late_s.value, 0, kMadeUp}, 3, 1);
  add(learned.heading_late_s,
      {"headings late", "s", kAbsent, learned.heading_late_s.value, 0, kMadeUp}, 3, 1);
  const bool has_wheels = std::isfinite(beside.wheel_radius_m);
  const double radius_m = has_wheels ? beside.wheel_radius_m : 1;
  add(learned.wheel_scale,
      {has_wheels ? "wheel_radius_m" : "speed scale", has_wheels ? "m" : "", beside.wheel_radius_m,
       radius_m * learned.wheel_scale.value, 0, kMadeUp},
      4, radius_m);
  const double slip = 1 / learned.turn_gain.value;
  add(learned.turn_gain, {"yaw_slip_factor", "", beside.yaw_slip_factor, slip, 0, kMadeUp}, 3,
      slip * slip);
  add(learned.gyro_scale, {"gyro scale", "", kAbsent, learned.gyro_scale.value, 0, kMadeUp}, 4, 1);
}

}  // namespace

LearnedOutlet::LearnedOutlet(const LearnedBeside& beside, std::optional<store::KeptLearned> stored)
    : beside_(beside) {
  given_.values.receiver = latest_.receiver = beside.receiver;
  given_.values.imu = latest_.imu = beside.imu;
  if (!stored) return;
  given_ = *stored;
  latest_ = stored->values;
  kept_s_ = stored->wall_s;
}

LearnedValues LearnedOutlet::wanted(const LearnedValues& now) {
  if (now.forgotten != forgotten_) {
    forgotten_ = now.forgotten;
    forgetting_ = true;
    return now;
  }
  if (now.receiver != beside_.receiver) return given_.values;
  LearnedValues all = now;
  const LearnedValues& before = given_.values;
  const auto keep = [](LearnedValue& value, const LearnedValue& older) {
    if (!value.known()) value = older;
  };
  keep(all.late_s, before.late_s);
  keep(all.heading_late_s, before.heading_late_s);
  keep(all.wheel_scale, before.wheel_scale);
  keep(all.turn_gain, before.turn_gain);
  if (now.imu != beside_.imu) {
    all.imu = beside_.imu;
    all.gyro_scale = {};
  }
  keep(all.gyro_scale, before.gyro_scale);
  return all;
}

std::vector<OutMessage> LearnedOutlet::on_snapshot(const Snapshot& seen, const Moment& moment,
                                                   Actions& out) {
  if (seen.time == kNever) return {};
  const bool now_forgotten = seen.learned.forgotten != forgotten_;
  const LearnedValues all = wanted(seen.learned);
  latest_ = all;
  const Duration each = seen.nav.status == NavStatus::run ? kEachDriving : kEachResting;
  const bool soon = given_at_ != kNever && moment.now - given_at_ < each;
  const bool wanted_there = differs(all, given_.values) || !problem_.empty();
  if (!now_forgotten && (under_way_ || soon || !wanted_there)) return {};
  given_.values = all;
  given_.subject = beside_.subject;
  given_.wall_s = to_s(moment.now.time_since_epoch() + moment.wall_minus_monotonic);
  given_at_ = moment.now;
  under_way_ = true;
  out.emplace_back(
      store::StorageJob{{RequestId::Source::internal, ++last_number_}, store::SaveLearned{given_}});
  return {};
}

void LearnedOutlet::on_stored(const store::StorageReply& reply, Actions& out) {
  if (reply.id.number != last_number_) return;  // a younger one is on its way
  under_way_ = false;
  if (reply.ok) {
    kept_s_ = given_.wall_s;
    problem_.clear();
    forgetting_ = false;
    return;
  }
  // Told once, and tried again.
  const char* what = forgetting_
                         ? "what was forgotten of the robot comes back with the next start: "
                         : "what was learned of the robot is lost with droverd: ";
  if (problem_.empty()) out.emplace_back(LogLine{Notice::Level::warning, what + reply.reason});
  problem_ = reply.reason;
}

std::string LearnedOutlet::shown() const {
  json::JsonText out;
  out.open('{').key("ok").boolean(true).key("learned").open('{');
  out.key("values").open('[');
  write_values(out, latest_, beside_);
  out.close(']').key("kept_s");
  if (kept_s_) {
    out.number(*kept_s_, 0);
  } else {
    out.null();
  }
  out.key("problem").text(problem_).close('}').close('}');
  return out.take();
}

bool LearnedOutlet::on_line(ClientId client, std::string_view line, Time /*now*/, Actions& out) {
  const auto document = json::parse(line, {.max_bytes = 1024, .max_depth = 2, .max_values = 8});
  if (!document || text_member(document->root, "cmd") != "learned") return false;
  out.emplace_back(Reply{client, shown()});
  return true;
}

}  // namespace drover::publish
